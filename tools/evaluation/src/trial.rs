use crate::{Fluency, HesitantReach, MovementTime, SkillTime, TurnedReach};
use coact_run_records::{SeparationReport, TimelineSpan, TrackingReport};
use serde::Serialize;

/// What came of one person's assembly, or of several one after another. Times are ms from the start.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Trial {
    /// The task's name.
    pub task: String,
    /// Seed of partner, sensors and noise.
    pub seed: u64,
    /// When the last part of the last assembly came into its place.
    pub completed_ms: Option<u64>,
    /// How long it was watched.
    pub ended_ms: u64,
    /// It was given up because no subgoal had been achieved for a minute, though one was open: a deadlock.
    pub stalled: bool,
    /// What the layers showed in the end of an assembly that was not completed.
    pub last_fields: Vec<String>,
    /// Subgoals of the last assembly that were then achieved, by name.
    pub achieved: Vec<String>,
    /// The person's actions.
    pub actions: Vec<PartnerAction>,
    /// Errors that were none.
    pub false_alarms: Vec<Alarm>,
    /// Ticks with two peaks in one decision layer.
    pub double_peaks: u64,
    /// The first of them.
    pub first_double: Option<DoublePeak>,
    /// Until completion, or the end.
    pub fluency: Fluency,
    /// How near robot and person came.
    pub separation: SeparationReport,
    /// Who did what, and who waited for whom.
    pub timeline: Vec<TimelineSpan>,
    /// How long it took until what the robot decided was done.
    pub skills: Vec<SkillTime>,
    /// How long the arm's movements took.
    pub movements: Vec<MovementTime>,
    /// How far the joints were from where they were to be.
    pub tracking: TrackingReport,
}

impl Trial {
    /// Functional delay of the turns that depend on each other, ms: the mean time from the end of the person's reach, which
    /// is the grasp, to the beginning of the robot's complementary action, which is its decision; negative where the robot
    /// began before. Independent work of the two, which overlaps in any case, counts for nothing here. 0 without answers.
    pub fn answer_delay_ms(&self) -> f64 {
        let leads = self.actions.iter().filter_map(|action| action.lead_ms);
        let (count, total) = leads.fold((0, 0), |(count, total), lead| (count + 1, total + lead));
        -(total as f64) / f64::from(count.max(1))
    }
}

/// One of the person's actions, and what the robot made of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PartnerAction {
    /// From 1.
    pub number: u32,
    /// What the person did, e.g. "insert: wheel".
    pub chain: String,
    /// The subgoal that was meant.
    pub subgoal: String,
    /// What was wrong with it.
    pub error: Option<ErrorKind>,
    /// Whether it led behind something that hid the part, and the hand at it.
    pub hidden: bool,
    /// Reaches for a part that this person had completed before: what the robot could have learned of the person's hand.
    pub earlier_reaches: u32,
    /// Whether it was made with the left hand.
    pub left_hand: bool,
    /// Of a hidden one: how many goals plan and memory left at grasp completion, by what the robot could know of them.
    pub hidden_goals: Option<usize>,
    /// Reach onset.
    pub onset_ms: u64,
    /// Grasp completion, or when the gesture was fully shown; none when it was broken off before.
    pub grasp_ms: Option<u64>,
    /// What stood in IL at grasp completion.
    pub inferred: Option<String>,
    /// Whether that was what was meant.
    pub inference: Option<Inference>,
    /// The first goal that stood for 50 ms on the way, an inference that nothing corrects; where none rose on the way, what stood at the grasp.
    pub first_inferred: Option<String>,
    /// Whether that was what was meant.
    pub first_inference: Option<Inference>,
    /// Angle between the part that is reached for and the nearest one of another kind, as seen from where the hand set out, degrees;
    /// none where there is no other one, and for gestures.
    pub nearest_deg: Option<f64>,
    /// Grasp completion minus the decision for the complementary action; none for errors, and without a decision.
    pub lead_ms: Option<i64>,
    /// The decision that counts.
    pub decided: Option<String>,
    /// Whether it was the complementary action, or, of an error, the correction that belongs to it.
    pub answered: bool,
    /// When the right error's peak rose in EML.
    pub detected_ms: Option<u64>,
    /// Whether that was in time; none for valid actions, and for what was broken off before the grasp.
    pub detection: Option<Detection>,
    /// What the layers showed at grasp completion.
    pub fields: Vec<String>,
    /// How the person changed the mind on the way. What was meant, and what was wrong with it, is as it was from then on.
    pub turn: Option<TurnedReach>,
    /// If the hand hesitated in mid-reach: how the robot bore it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hesitation: Option<HesitantReach>,
}

impl PartnerAction {
    /// Whether the right answer was decided before the hand set out.
    pub(crate) fn is_predicted(&self) -> bool {
        let reach_ms = self.grasp_ms.map(|grasp| grasp as i64 - self.onset_ms as i64);
        self.lead_ms.zip(reach_ms).is_some_and(|(lead, reach)| lead > reach)
    }
}

/// What is wrong with an action.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ErrorKind {
    /// Intention: the subgoal's turn has not come, shown by a grip.
    Early,
    /// Intention: the subgoal is achieved already.
    Done,
    /// Intention: a part is requested whose turn has not come. A gesture names no part: which of those is meant whose turn has not
    /// come, nothing shows.
    Requested,
    /// Means: a part is requested that lies in the person's own workspace.
    AtHand,
}

impl ErrorKind {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Early, Self::Done, Self::Requested, Self::AtHand];

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Early => "taken too early",
            Self::Done => "taken for what is done",
            Self::Requested => "requested too early",
            Self::AtHand => "requested though at hand",
        }
    }
}

/// What was inferred of an action, at grasp completion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Inference {
    /// The goal that was meant.
    Right,
    /// Another one.
    Wrong,
    /// None.
    Absent,
}

/// Whether an error was noticed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Detection {
    /// Before the grasp was complete.
    InTime,
    /// Later, in the same action.
    Late,
    /// Not in this action.
    Missed,
}

/// A peak in EML for which there was no reason.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Alarm {
    /// When it rose.
    pub at_ms: u64,
    /// The population.
    pub error: String,
    /// Number of the valid action during which it rose; none while the person rested.
    pub action: Option<u32>,
    /// What the layers showed.
    pub fields: Vec<String>,
}

/// Two peaks in one decision layer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DoublePeak {
    /// When.
    pub at_ms: u64,
    /// Where.
    pub layer: String,
    /// The populations.
    pub peaks: Vec<String>,
}
