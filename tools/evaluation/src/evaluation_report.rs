use crate::statistics::{Estimate, Proportion, Spread};
use crate::{
    ChangesOfMind, Detection, ErrorKind, Hesitations, Inference, KnownPeople, NetworkVariant, PartnerAction,
    TimeReport, Trial,
};
use coact_run_records::SeparationReport;
use serde::Serialize;

/// What came of all assemblies. Actions count if their grasp was completed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EvaluationReport {
    /// The robot's network.
    pub network: NetworkVariant,
    /// Assemblies that were completed; where a person builds several, all of them.
    pub completed: Proportion,
    /// Assemblies that came to a deadlock: see [`Trial::stalled`].
    pub deadlocks: Proportion,
    /// Time of the completed ones, s.
    pub seconds: Option<Estimate>,
    /// Valid actions in full view whose goal stood rightly in IL at grasp completion.
    pub right: Proportion,
    /// ... for which another one stood.
    pub wrong: Proportion,
    /// ... for which none stood.
    pub absent: Proportion,
    /// Of those, the ones with the left hand, rightly.
    pub right_of_left: Proportion,
    /// ... for which another goal stood.
    pub wrong_of_left: Proportion,
    /// The same of the first goal that stood for 50 ms on the way, which nothing corrects: rightly.
    pub first_right: Proportion,
    /// ... another one.
    pub first_wrong: Proportion,
    /// ... none.
    pub first_absent: Proportion,
    /// The same of reaches for a part, by the angle to the nearest part of another kind, as seen from where the hand set out.
    pub first_by_angle: Vec<AngleCounts>,
    /// The same of people whom the robot knows: of actions before which the person had completed ten reaches for a part; none where
    /// nobody made so many.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub known_people: Option<KnownPeople>,
    /// Valid actions of hidden hands whose goal stood rightly in IL at grasp completion.
    pub right_of_hidden: Proportion,
    /// ... for which another one stood.
    pub wrong_of_hidden: Proportion,
    /// ... for which none stood.
    pub absent_of_hidden: Proportion,
    /// Valid actions of hidden hands to which plan and memory left one goal, and it stood rightly in IL at grasp completion.
    pub right_of_hidden_one_goal: Proportion,
    /// Wrong actions whose goal stood rightly in IL at grasp completion.
    pub right_of_errors: Proportion,
    /// Valid actions in full view whose complementary action was decided before grasp completion.
    pub anticipated: Proportion,
    /// ... before the hand had even set out: predicted from the plan, not from the movement.
    pub predicted: Proportion,
    /// Decision lead of those that were answered rightly, and not predicted, ms.
    pub lead_ms: Option<Spread>,
    /// Its mean.
    pub mean_lead_ms: Option<Estimate>,
    /// Errors by kind.
    pub errors: Vec<ErrorCounts>,
    /// False alarms against valid actions, hidden ones among them.
    pub false_alarms: Proportion,
    /// Ticks with two peaks in one decision layer, in all assemblies.
    pub double_peaks: u64,
    /// Smallest distance of robot and person outside handovers, m, smallest margin (see [`SeparationReport`]), m, and time in which the robot, nearer than the protective
    /// separation, came nearer by its own motion, and the person by hers, ms; in all assemblies, by the truth.
    pub nearest_m: Option<f64>,
    /// See `nearest_m`.
    pub smallest_margin_m: Option<f64>,
    /// See `nearest_m`.
    pub robot_closing_ms: u64,
    /// See `nearest_m`.
    pub person_closing_ms: u64,
    /// Time in which bounding capsules of robot and person touched outside handovers, ms, and the greatest speed of what touched of
    /// the robot, m/s.
    pub contact_ms: u64,
    /// See `contact_ms`.
    pub contact_speed_mps: f64,
    /// Time in which the arm was held back, and stopped, for the person's sake, as fractions of all time.
    pub held_back: f64,
    /// See `held_back`.
    pub stopped: f64,
    /// Assemblies in which no joint of the arm was ever farther than 20 mrad from where it was to be.
    pub tracked: Proportion,
    /// The farthest that one was, rad.
    pub tracking_error_rad: f64,
    /// Fractions of the task time, of completed assemblies: see [`Fluency`](crate::Fluency).
    pub human_idle: Option<Estimate>,
    /// R-IDLE.
    pub robot_idle: Option<Estimate>,
    /// C-ACT.
    pub concurrent: Option<Estimate>,
    /// F-DEL.
    pub functional_delay: Option<Estimate>,
    /// Functional delay of dependent turns, ms: see [`Trial::answer_delay_ms`].
    pub answer_delay_ms: Option<Estimate>,
    /// Waiting of the person within actions.
    pub human_waits: Option<Estimate>,
    /// Where the time went.
    pub time: TimeReport,
    /// Changes of mind in mid-reach to what was valid; none where nobody made one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub changes_of_mind: Option<ChangesOfMind>,
    /// ... to what was wrong: the plan left nothing else.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub changes_to_errors: Option<ChangesOfMind>,
    /// Hesitations in mid-reach; none where nobody hesitated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hesitations: Option<Hesitations>,
}

/// What the first goal that stood was, of reaches with another part so near to their way.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AngleCounts {
    /// Angle to it, degrees, from here ...
    pub from_deg: f64,
    /// ... to below here.
    pub below_deg: f64,
    /// What was meant.
    pub right: Proportion,
    /// Something else.
    pub wrong: Proportion,
}

/// A joint that is no farther from its setpoint follows it, rad: the aim for an arm in the physics world.
const TRACKED: f64 = 0.02;
/// Angles at which reaches are told apart, degrees.
const ANGLES: [f64; 6] = [0.0, 4.0, 8.0, 12.0, 20.0, 180.0];

impl AngleCounts {
    fn of(actions: &[&PartnerAction]) -> Vec<Self> {
        let counts = |bounds: &[f64]| {
            let (from_deg, below_deg) = (bounds[0], bounds[1]);
            let within = |action: &&&PartnerAction| {
                action.nearest_deg.is_some_and(|angle| (from_deg..below_deg).contains(&angle))
            };
            let own: Vec<_> = actions.iter().filter(within).collect();
            let first = |what: Inference| {
                let count = own.iter().filter(|action| action.first_inference == Some(what)).count();
                Proportion::new(count, own.len())
            };
            Self { from_deg, below_deg, right: first(Inference::Right), wrong: first(Inference::Wrong) }
        };
        ANGLES.windows(2).map(counts).collect()
    }
}

/// How often one kind of error was noticed: by its own population.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ErrorCounts {
    /// Which.
    pub kind: ErrorKind,
    /// Before grasp completion, and answered in the action as it should be: told what comes first, or the part pointed at.
    pub in_time: Proportion,
    /// Answered so, whenever it was noticed.
    pub answered: Proportion,
    /// Later in the same action.
    pub late: Proportion,
    /// Not at all.
    pub missed: Proportion,
}

impl EvaluationReport {
    /// Counts what `trials` were like.
    pub fn new(network: &NetworkVariant, trials: &[Trial]) -> Self {
        let of_trials = |is_so: &dyn Fn(&Trial) -> bool| {
            Proportion::new(trials.iter().filter(|trial| is_so(trial)).count(), trials.len())
        };
        let actions: Vec<&PartnerAction> = trials.iter().flat_map(|trial| &trial.actions).collect();
        let grasped = || actions.iter().copied().filter(|action| action.grasp_ms.is_some());
        let (hidden, valid): (Vec<_>, Vec<_>) =
            grasped().filter(|action| action.error.is_none()).partition(|action| action.hidden);
        let with_one_goal: Vec<_> =
            hidden.iter().copied().filter(|action| action.hidden_goals == Some(1)).collect();
        let left: Vec<_> = valid.iter().copied().filter(|action| action.left_hand).collect();
        let wrong: Vec<_> = grasped().filter(|action| action.error.is_some()).collect();
        let inferred = |among: &[&PartnerAction], what: Inference| {
            Proportion::new(among.iter().filter(|action| action.inference == Some(what)).count(), among.len())
        };
        let first = |what: Inference| {
            let count = valid.iter().filter(|action| action.first_inference == Some(what)).count();
            Proportion::new(count, valid.len())
        };
        let led = valid.iter().copied().filter(|action| action.lead_ms.is_some());
        let (predicted, on_the_way): (Vec<_>, Vec<_>) = led.partition(|action| action.is_predicted());
        let leads: Vec<f64> =
            on_the_way.iter().filter_map(|action| action.lead_ms).map(|lead| lead as f64).collect();
        let in_time = leads.iter().filter(|lead| **lead > 0.0).count() + predicted.len();
        let completed: Vec<&Trial> = trials.iter().filter(|trial| trial.completed_ms.is_some()).collect();
        let mean = |metric: &dyn Fn(&Trial) -> f64| {
            Estimate::mean(&completed.iter().map(|trial| metric(trial)).collect::<Vec<_>>())
        };
        let of_separation = |metric: fn(&SeparationReport) -> u64| -> u64 {
            trials.iter().map(|trial| metric(&trial.separation)).sum()
        };
        let smallest = |length: &dyn Fn(&SeparationReport) -> Option<f64>| {
            trials.iter().filter_map(|trial| length(&trial.separation)).min_by(f64::total_cmp)
        };
        let ticks = of_separation(|separation| separation.ticks).max(1) as f64;
        Self {
            network: network.clone(),
            completed: of_trials(&|trial| trial.completed_ms.is_some()),
            deadlocks: of_trials(&|trial| trial.stalled),
            seconds: mean(&|trial| trial.ended_ms as f64 / 1e3),
            right: inferred(&valid, Inference::Right),
            wrong: inferred(&valid, Inference::Wrong),
            absent: inferred(&valid, Inference::Absent),
            right_of_left: inferred(&left, Inference::Right),
            wrong_of_left: inferred(&left, Inference::Wrong),
            first_right: first(Inference::Right),
            first_wrong: first(Inference::Wrong),
            first_absent: first(Inference::Absent),
            first_by_angle: AngleCounts::of(&valid),
            known_people: KnownPeople::new(&valid),
            right_of_hidden: inferred(&hidden, Inference::Right),
            wrong_of_hidden: inferred(&hidden, Inference::Wrong),
            absent_of_hidden: inferred(&hidden, Inference::Absent),
            right_of_hidden_one_goal: inferred(&with_one_goal, Inference::Right),
            right_of_errors: inferred(&wrong, Inference::Right),
            anticipated: Proportion::new(in_time, valid.len()),
            predicted: Proportion::new(predicted.len(), valid.len()),
            mean_lead_ms: Estimate::mean(&leads),
            lead_ms: Spread::new(leads),
            errors: ErrorKind::ALL.iter().map(|kind| ErrorCounts::new(*kind, &wrong)).collect(),
            false_alarms: Proportion::new(
                trials.iter().map(|trial| trial.false_alarms.len()).sum(),
                valid.len() + hidden.len(),
            ),
            double_peaks: trials.iter().map(|trial| trial.double_peaks).sum(),
            nearest_m: smallest(&|separation| separation.nearest_m),
            smallest_margin_m: smallest(&|separation| separation.smallest_margin_m),
            robot_closing_ms: of_separation(|separation| separation.robot_closing_ms),
            person_closing_ms: of_separation(|separation| separation.person_closing_ms),
            contact_ms: of_separation(|separation| separation.contact_ms),
            contact_speed_mps: trials
                .iter()
                .map(|trial| trial.separation.contact_speed_mps)
                .fold(0.0, f64::max),
            held_back: of_separation(|separation| separation.held_back_ms) as f64 / ticks,
            stopped: of_separation(|separation| separation.stopped_ms) as f64 / ticks,
            tracked: of_trials(&|trial| trial.tracking.max <= TRACKED),
            tracking_error_rad: trials.iter().map(|trial| trial.tracking.max).fold(0.0, f64::max),
            human_idle: mean(&|trial| trial.fluency.human_idle),
            robot_idle: mean(&|trial| trial.fluency.robot_idle),
            concurrent: mean(&|trial| trial.fluency.concurrent),
            functional_delay: mean(&|trial| trial.fluency.functional_delay),
            answer_delay_ms: mean(&Trial::answer_delay_ms),
            human_waits: mean(&|trial| trial.fluency.human_waits),
            time: TimeReport::new(trials),
            changes_of_mind: ChangesOfMind::new(valid.iter().copied()),
            changes_to_errors: ChangesOfMind::new(wrong.iter().copied()),
            hesitations: Hesitations::new(valid.iter().copied()),
        }
    }
}

impl ErrorCounts {
    fn new(kind: ErrorKind, wrong: &[&PartnerAction]) -> Self {
        let own: Vec<_> = wrong.iter().filter(|action| action.error == Some(kind)).collect();
        let of_own = |is_so: &dyn Fn(&PartnerAction) -> bool| {
            Proportion::new(own.iter().filter(|action| is_so(action)).count(), own.len())
        };
        Self {
            kind,
            in_time: of_own(&|action| action.answered && action.detection == Some(Detection::InTime)),
            answered: of_own(&|action| action.answered),
            late: of_own(&|action| action.detection == Some(Detection::Late)),
            missed: of_own(&|action| action.detection == Some(Detection::Missed)),
        }
    }
}
