use crate::Trial;
use crate::movement_times::MovementTime;
use crate::skill_times::{SkillKind, SkillTime};
use crate::statistics::{Estimate, Spread};
use coact_run_records::{Occupation, TimelineSpan, Waiting};
use serde::Serialize;

/// Where the time of completed assemblies went.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TimeReport {
    /// How long an assembly took, s.
    pub seconds: Option<Spread>,
    /// How long the person waited for the robot in an assembly: within actions, and for steps of the robot's own, s.
    pub person_waits_s: Option<Estimate>,
    /// What the robot did for how long in an assembly.
    pub robot: Vec<OccupationTime>,
    /// What the person did.
    pub person: Vec<OccupationTime>,
    /// How long it took from a decision until it was done.
    pub skills: Vec<SkillDuration>,
    /// How long the arm's movements took, over the shortest time in which their paths could be followed, whatever the jerk: as planned.
    pub planned_over_shortest: Option<Spread>,
    /// The same as it came about: longer where the arm was held back.
    pub taken_over_shortest: Option<Spread>,
}

/// What an agent did in an assembly, in the mean.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OccupationTime {
    /// What.
    pub occupation: Occupation,
    /// For how long, s.
    pub seconds: Estimate,
}

/// How long it took until a decision was done.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SkillDuration {
    /// Which.
    pub skill: SkillKind,
    /// How many.
    pub count: usize,
    /// How long, s.
    pub seconds: Spread,
    /// The longest, s.
    pub longest_s: f64,
}

impl TimeReport {
    /// Of these assemblies; those that were not completed are left out.
    pub fn new(trials: &[Trial]) -> Self {
        let completed: Vec<&Trial> = trials.iter().filter(|trial| trial.completed_ms.is_some()).collect();
        let each = |metric: &dyn Fn(&Trial) -> f64| -> Vec<f64> {
            completed.iter().map(|trial| metric(trial)).collect()
        };
        let spent = |who: Waiting| -> Vec<OccupationTime> {
            let spans = completed.iter().flat_map(|trial| &trial.timeline);
            let mut found: Vec<_> =
                spans.filter(|span| span.who == who).map(|span| span.occupation).collect();
            found.sort();
            found.dedup();
            let of = |occupation: Occupation| {
                let seconds = each(&|trial| seconds(&trial.timeline, who, |own| own == occupation));
                Some(OccupationTime { occupation, seconds: Estimate::mean(&seconds)? })
            };
            found.into_iter().filter_map(of).collect()
        };
        let movements = || completed.iter().flat_map(|trial| &trial.movements);
        let over_shortest = |time: fn(&MovementTime) -> f64| {
            Spread::new(movements().map(|movement| time(movement) / movement.shortest_s).collect())
        };
        Self {
            seconds: Spread::new(each(&|trial| trial.ended_ms as f64 / 1e3)),
            person_waits_s: Estimate::mean(&each(&|trial| {
                seconds(&trial.timeline, Waiting::Person, Occupation::is_waiting)
            })),
            robot: spent(Waiting::Robot),
            person: spent(Waiting::Person),
            skills: SkillKind::ALL
                .into_iter()
                .filter_map(|skill| SkillDuration::of(skill, &completed))
                .collect(),
            planned_over_shortest: over_shortest(|movement| movement.planned_s),
            taken_over_shortest: over_shortest(|movement| movement.taken_s),
        }
    }
}

impl SkillDuration {
    fn of(skill: SkillKind, trials: &[&Trial]) -> Option<Self> {
        let own = trials.iter().flat_map(|trial| &trial.skills).filter(|time| time.skill == skill);
        let seconds: Vec<f64> = own.map(SkillTime::seconds).collect();
        let longest_s = seconds.iter().copied().fold(0.0, f64::max);
        Some(Self { skill, count: seconds.len(), longest_s, seconds: Spread::new(seconds)? })
    }
}

fn seconds(timeline: &[TimelineSpan], who: Waiting, is_meant: impl Fn(Occupation) -> bool) -> f64 {
    let own = timeline.iter().filter(|span| span.who == who && is_meant(span.occupation));
    own.map(TimelineSpan::seconds).sum()
}
