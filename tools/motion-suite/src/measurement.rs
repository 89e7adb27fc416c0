use crate::{Case, Quality, Scenario, Setting};
use coact_motion::{Clearance, Goal, Mechanism, MinClearance, Plan, Refusal, SegmentKind, path_exists};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rustix::time::{ClockId, clock_gettime};

/// What became of one case.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// Time of planning, ms.
    pub planning_ms: f64,
    /// How the movement looks, or why there is none.
    pub result: Result<(Plan, Quality), Refusal>,
    /// Whether a solution is known: planned, or a path found by the long search.
    pub solvable: bool,
}

/// All cases of one scenario.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Measurement {
    /// The scenario.
    pub scenario: &'static str,
    /// Its robot.
    pub robot: String,
    /// Cases.
    pub cases: usize,
    /// Cases that have a solution, as far as is known.
    pub solvable: usize,
    /// Cases that were solved.
    pub solved: usize,
    /// Time of planning, ms: median, 99th percentile, largest; of solved cases.
    pub planning_ms: [f64; 3],
    /// Fraction of the cases in which a bounce or a detour was needed.
    pub bounced: f64,
    /// Largest number of movement units in one movement.
    pub units: u32,
    /// Fraction of the movements with one movement unit.
    pub single_unit: f64,
    /// Median of the normalised jerk.
    pub normalised_jerk: f64,
    /// Median duration of the movement, s.
    pub duration_s: f64,
    /// The same over the shortest time in which the path can be followed whatever the jerk: median.
    pub over_shortest: f64,
    /// Largest distance from the goal at the end, m.
    pub position_error: f64,
    /// Smallest clearance on a reach, m.
    pub clearance: f64,
    /// What was said about the unsolved cases.
    pub refusals: Vec<String>,
}

/// Runs `count` cases of a scenario.
pub fn measure(
    setting: &Setting,
    scenario: Scenario,
    count: usize,
    seed: u64,
    done: &mut dyn FnMut(),
) -> Measurement {
    let mut random = Pcg64::seed_from_u64(seed);
    let outcomes: Vec<Outcome> = (0..count)
        .filter_map(|_| {
            let case = scenario.case(setting, &mut random);
            done();
            case.map(|case| judged(&setting.mechanism, &case))
        })
        .collect();
    summary(setting, scenario, &outcomes)
}

fn judged(mechanism: &Mechanism, case: &Case) -> Outcome {
    let problem = case.problem(mechanism);
    let began = thread_ms();
    let planned = problem.plan();
    let planning_ms = thread_ms() - began;
    let solvable = match &planned {
        Ok(_) => true,
        Err(Refusal::NoPath { .. }) => {
            let from = case.start.map(|state| state.position);
            let ends = match &case.goal {
                Goal::Posture(at) => vec![*at],
                Goal::Hand(_) => problem.targets_from(&from).iter().map(|target| target.before).collect(),
            };
            let clearance = Clearance {
                mechanism,
                collision_model: &case.collision_model,
                scene: &case.scene,
                segment: SegmentKind::Reach,
            };
            ends.iter().any(|end| path_exists(&clearance, &from, end, MinClearance::default().path))
        }
        Err(_) => false,
    };
    let result = planned.map(|plan| {
        let quality = Quality::of(&problem, &plan);
        (plan, quality)
    });
    Outcome { planning_ms, result, solvable }
}

/// Time that this thread has worked, ms: what else runs on the machine does not count.
fn thread_ms() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    1e3 * time.tv_sec as f64 + 1e-6 * time.tv_nsec as f64
}

fn summary(setting: &Setting, scenario: Scenario, outcomes: &[Outcome]) -> Measurement {
    let solved: Vec<(&Outcome, &Plan, &Quality)> = outcomes
        .iter()
        .filter_map(|outcome| outcome.result.as_ref().ok().map(|(plan, quality)| (outcome, plan, quality)))
        .collect();
    let sorted = |of: &dyn Fn(&(&Outcome, &Plan, &Quality)) -> f64| {
        let mut values: Vec<f64> = solved.iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        values
    };
    let times = sorted(&|(outcome, ..)| outcome.planning_ms);
    let fraction = |of: &dyn Fn(&(&Outcome, &Plan, &Quality)) -> bool| {
        solved.iter().filter(|one| of(one)).count() as f64 / solved.len().max(1) as f64
    };
    let refusals = outcomes.iter().filter_map(|outcome| {
        let refusal = outcome.result.as_ref().err()?;
        Some(format!("{}: {refusal}", if outcome.solvable { "missed" } else { "refused" }))
    });
    Measurement {
        scenario: scenario.name(),
        robot: setting.mechanism.name.clone(),
        cases: outcomes.len(),
        solvable: outcomes.iter().filter(|outcome| outcome.solvable).count(),
        solved: solved.len(),
        planning_ms: [0.5, 0.99, 1.0].map(|fraction| quantile(&times, fraction)),
        bounced: fraction(&|(_, plan, _)| plan.bounces),
        units: solved.iter().map(|(.., quality)| quality.units).max().unwrap_or(0),
        single_unit: fraction(&|(.., quality)| quality.units == 1),
        normalised_jerk: quantile(&sorted(&|(.., quality)| quality.normalised_jerk), 0.5),
        duration_s: quantile(&sorted(&|(.., quality)| quality.duration_s), 0.5),
        over_shortest: quantile(&sorted(&|(.., quality)| quality.over_shortest), 0.5),
        position_error: quantile(&sorted(&|(.., quality)| quality.position_error), 1.0),
        clearance: quantile(&sorted(&|(.., quality)| quality.clearance), 0.0),
        refusals: refusals.collect(),
    }
}

/// Quantile of sorted values; NaN without values.
fn quantile(sorted: &[f64], fraction: f64) -> f64 {
    let index = (fraction * (sorted.len().max(1) - 1) as f64).round() as usize;
    sorted.get(index).copied().unwrap_or(f64::NAN)
}
