use crate::statistics::{Estimate, Proportion, Spread};
use crate::{
    ChangesOfMind, Detection, ErrorKind, Hesitations, Inference, NetworkVariant, PartnerAction, Trial,
};
use coact_run_records::SeparationReport;
use serde::Serialize;

/// What came of all assemblies. Actions count if their grasp was completed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EvaluationReport {
    /// The robot's network.
    pub network: NetworkVariant,
    /// Assemblies that were completed.
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
    /// Valid actions of hidden hands whose goal stood rightly in IL at grasp completion.
    pub right_of_hidden: Proportion,
    /// ... for which another one stood.
    pub wrong_of_hidden: Proportion,
    /// ... for which none stood.
    pub absent_of_hidden: Proportion,
    /// Wrong actions whose goal stood rightly in IL at grasp completion.
    pub right_of_errors: Proportion,
    /// Valid actions in full view whose complementary action was decided before grasp completion.
    pub anticipated: Proportion,
    /// Decision lead of all of them that were answered rightly, ms.
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

/// How often one kind of error was noticed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ErrorCounts {
    /// Which.
    pub kind: ErrorKind,
    /// Before grasp completion.
    pub in_time: Proportion,
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
        let wrong: Vec<_> = grasped().filter(|action| action.error.is_some()).collect();
        let inferred = |among: &[&PartnerAction], what: Inference| {
            Proportion::new(among.iter().filter(|action| action.inference == Some(what)).count(), among.len())
        };
        let leads: Vec<f64> =
            valid.iter().filter_map(|action| action.lead_ms).map(|lead| lead as f64).collect();
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
            right_of_hidden: inferred(&hidden, Inference::Right),
            wrong_of_hidden: inferred(&hidden, Inference::Wrong),
            absent_of_hidden: inferred(&hidden, Inference::Absent),
            right_of_errors: inferred(&wrong, Inference::Right),
            anticipated: Proportion::new(leads.iter().filter(|lead| **lead > 0.0).count(), valid.len()),
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
            human_idle: mean(&|trial| trial.fluency.human_idle),
            robot_idle: mean(&|trial| trial.fluency.robot_idle),
            concurrent: mean(&|trial| trial.fluency.concurrent),
            functional_delay: mean(&|trial| trial.fluency.functional_delay),
            answer_delay_ms: mean(&Trial::answer_delay_ms),
            human_waits: mean(&|trial| trial.fluency.human_waits),
            changes_of_mind: ChangesOfMind::new(valid.iter().copied()),
            changes_to_errors: ChangesOfMind::new(wrong.iter().copied()),
            hesitations: Hesitations::new(valid.iter().copied()),
        }
    }
}

impl ErrorCounts {
    fn new(kind: ErrorKind, wrong: &[&PartnerAction]) -> Self {
        let own: Vec<_> = wrong.iter().filter(|action| action.error == Some(kind)).collect();
        let proportion = |what: Detection| {
            Proportion::new(own.iter().filter(|action| action.detection == Some(what)).count(), own.len())
        };
        let (in_time, late) = (proportion(Detection::InTime), proportion(Detection::Late));
        Self { kind, in_time, late, missed: proportion(Detection::Missed) }
    }
}
