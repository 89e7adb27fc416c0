use crate::statistics::{Interval, Share, Spread};
use crate::{Detection, ErrorKind, Inference, Mind, PartnerAction, Trial};
use serde::Serialize;

/// What came of all assemblies. Actions count from the moment at which their grasp was complete.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// The robot's mind.
    pub mind: Mind,
    /// Assemblies that were completed.
    pub completed: Share,
    /// Assemblies that came to a standstill.
    pub deadlocks: Share,
    /// Time of the completed ones, s.
    pub seconds: Option<Interval>,
    /// Valid actions in full view whose goal stood rightly in IL at grasp completion.
    pub right: Share,
    /// ... for which another one stood.
    pub wrong: Share,
    /// ... for which none stood.
    pub absent: Share,
    /// Valid actions of hidden hands whose goal stood rightly in IL at grasp completion.
    pub right_of_hidden: Share,
    /// ... for which another one stood.
    pub wrong_of_hidden: Share,
    /// ... for which none stood.
    pub absent_of_hidden: Share,
    /// Wrong actions whose goal stood rightly in IL at grasp completion.
    pub right_of_errors: Share,
    /// Valid actions in full view whose complementary action was decided before grasp completion.
    pub anticipated: Share,
    /// Decision lead of all of them that were answered rightly, ms.
    pub lead_ms: Option<Spread>,
    /// Its mean.
    pub mean_lead_ms: Option<Interval>,
    /// Errors by kind.
    pub errors: Vec<ErrorTally>,
    /// False alarms against valid actions, hidden ones among them.
    pub false_alarms: Share,
    /// Ticks with two peaks in one decision layer, in all assemblies.
    pub double_peaks: u64,
    /// Shares of the task time, of completed assemblies: see [`Fluency`](crate::Fluency).
    pub human_idle: Option<Interval>,
    /// R-IDLE.
    pub robot_idle: Option<Interval>,
    /// C-ACT.
    pub concurrent: Option<Interval>,
    /// F-DEL.
    pub functional_delay: Option<Interval>,
    /// Functional delay of dependent turns, ms: see [`Trial::answer_delay_ms`].
    pub answer_delay_ms: Option<Interval>,
    /// Waiting of the person within actions.
    pub human_waits: Option<Interval>,
}

/// How often one kind of error was noticed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ErrorTally {
    /// Which.
    pub kind: ErrorKind,
    /// Before grasp completion.
    pub in_time: Share,
    /// Later in the same action.
    pub late: Share,
    /// Not at all.
    pub missed: Share,
}

impl Report {
    /// Counts what `trials` were like.
    pub fn new(mind: &Mind, trials: &[Trial]) -> Self {
        let of_trials = |is_so: &dyn Fn(&Trial) -> bool| {
            Share::new(trials.iter().filter(|trial| is_so(trial)).count(), trials.len())
        };
        let actions: Vec<&PartnerAction> = trials.iter().flat_map(|trial| &trial.actions).collect();
        let grasped = || actions.iter().copied().filter(|action| action.grasp_ms.is_some());
        let (hidden, valid): (Vec<_>, Vec<_>) =
            grasped().filter(|action| action.error.is_none()).partition(|action| action.hidden);
        let wrong: Vec<_> = grasped().filter(|action| action.error.is_some()).collect();
        let inferred = |among: &[&PartnerAction], what: Inference| {
            Share::new(among.iter().filter(|action| action.inference == Some(what)).count(), among.len())
        };
        let leads: Vec<f64> =
            valid.iter().filter_map(|action| action.lead_ms).map(|lead| lead as f64).collect();
        let completed: Vec<&Trial> = trials.iter().filter(|trial| trial.completed_ms.is_some()).collect();
        let mean = |figure: &dyn Fn(&Trial) -> f64| {
            Interval::mean(&completed.iter().map(|trial| figure(trial)).collect::<Vec<_>>())
        };
        Self {
            mind: mind.clone(),
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
            anticipated: Share::new(leads.iter().filter(|lead| **lead > 0.0).count(), valid.len()),
            mean_lead_ms: Interval::mean(&leads),
            lead_ms: Spread::new(leads),
            errors: ErrorKind::ALL.iter().map(|kind| ErrorTally::new(*kind, &wrong)).collect(),
            false_alarms: Share::new(
                trials.iter().map(|trial| trial.false_alarms.len()).sum(),
                valid.len() + hidden.len(),
            ),
            double_peaks: trials.iter().map(|trial| trial.double_peaks).sum(),
            human_idle: mean(&|trial| trial.fluency.human_idle),
            robot_idle: mean(&|trial| trial.fluency.robot_idle),
            concurrent: mean(&|trial| trial.fluency.concurrent),
            functional_delay: mean(&|trial| trial.fluency.functional_delay),
            answer_delay_ms: mean(&Trial::answer_delay_ms),
            human_waits: mean(&|trial| trial.fluency.human_waits),
        }
    }
}

impl ErrorTally {
    fn new(kind: ErrorKind, wrong: &[&PartnerAction]) -> Self {
        let own: Vec<_> = wrong.iter().filter(|action| action.error == Some(kind)).collect();
        let share = |what: Detection| {
            Share::new(own.iter().filter(|action| action.detection == Some(what)).count(), own.len())
        };
        let (in_time, late) = (share(Detection::InTime), share(Detection::Late));
        Self { kind, in_time, late, missed: share(Detection::Missed) }
    }
}
