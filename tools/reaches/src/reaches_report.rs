use crate::reach_outcome::{FRACTIONS, GoalDecision, ReachOutcome};
use serde::Serialize;

/// How many reaches of a person count as the first.
pub const FIRST: usize = 10;

/// What was inferred from all reaches, and from each person's.
#[derive(Debug, Clone, Serialize)]
pub struct ReachesReport {
    /// The plan.
    pub task: String,
    /// How many goals it leaves possible.
    pub goals: usize,
    /// All people.
    pub overall: ReachTally,
    /// Each person, in the order of the folder.
    pub people: Vec<(u32, ReachTally)>,
    /// The first [`FIRST`] reaches of each person that were played: little is known of them yet.
    pub first: ReachTally,
    /// Each width of object, m, ascending.
    pub widths: Vec<(f64, ReachTally)>,
    /// Every reach.
    pub reaches: Vec<ReachOutcome>,
}

/// Metrics of some reaches. Fractions are of all of them: no decision counts as not right.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReachTally {
    /// Reaches.
    pub reaches: usize,
    /// Decided rightly before contact.
    pub right: usize,
    /// Decided wrongly.
    pub wrong: usize,
    /// Not decided.
    pub undecided: usize,
    /// Fraction decided rightly before contact.
    pub right_fraction: f64,
    /// Fraction for which the right goal stood at 20, 40, 60, 80 and 100 % of movement time.
    pub right_during_reach: [f64; 5],
    /// Contact minus decision, ms, of right ones: p5, p50, p95; `None` without any.
    pub lead_ms: Option<[i64; 3]>,
    /// Fraction that the robot had decided to answer rightly (AEL) before contact.
    pub answered_fraction: f64,
    /// Contact minus the right answer's decision, ms: p5, p50, p95; `None` without any.
    pub answer_lead_ms: Option<[i64; 3]>,
    /// Perception's onset minus the label, ms: p5, p50, p95.
    pub onset_ms: Option<[i64; 3]>,
    /// Reaches whose onset perception missed before contact.
    pub onset_missed: usize,
}

impl ReachesReport {
    /// Counts the outcomes, which stand person by person, in the order in which their reaches were played.
    pub fn new(task: &str, goals: usize, reaches: Vec<ReachOutcome>) -> Self {
        let mut people: Vec<u32> = reaches.iter().map(|outcome| outcome.participant).collect();
        people.dedup();
        let mut widths: Vec<f64> = reaches.iter().map(|outcome| outcome.width).collect();
        widths.sort_unstable_by(f64::total_cmp);
        widths.dedup();
        let of = |person: u32| reaches.iter().filter(move |outcome| outcome.participant == person);
        let wide = |width: f64| reaches.iter().filter(move |outcome| outcome.width == width);
        Self {
            task: task.to_owned(),
            goals,
            overall: ReachTally::of(reaches.iter()),
            first: ReachTally::of(people.iter().flat_map(|person| of(*person).take(FIRST))),
            widths: widths.into_iter().map(|width| (width, ReachTally::of(wide(width)))).collect(),
            people: people.into_iter().map(|person| (person, ReachTally::of(of(person)))).collect(),
            reaches,
        }
    }
}

impl ReachTally {
    fn of<'a>(outcomes: impl Iterator<Item = &'a ReachOutcome> + Clone) -> Self {
        let reaches = outcomes.clone().count();
        let right = outcomes.clone().filter(|outcome| outcome.is_right()).count();
        let undecided = outcomes.clone().filter(|outcome| outcome.decision.is_none()).count();
        let fraction = |count: usize| count as f64 / reaches.max(1) as f64;
        let stood = |at: usize| {
            outcomes.clone().filter(|outcome| outcome.right_during_reach[at] == Some(true)).count()
        };
        let leads = |of: fn(&ReachOutcome) -> Option<GoalDecision>| {
            let decisions = outcomes.clone().filter_map(of).filter(|decision| decision.right);
            percentiles(decisions.map(|decision| decision.lead_ms).collect())
        };
        Self {
            reaches,
            right,
            wrong: reaches - right - undecided,
            undecided,
            right_fraction: fraction(right),
            right_during_reach: std::array::from_fn::<_, { FRACTIONS.len() }, _>(|at| fraction(stood(at))),
            lead_ms: leads(|outcome| outcome.decision),
            answered_fraction: fraction(outcomes.clone().filter(|outcome| outcome.is_answered()).count()),
            answer_lead_ms: leads(|outcome| outcome.answer),
            onset_ms: percentiles(outcomes.clone().filter_map(|outcome| outcome.onset_ms).collect()),
            onset_missed: outcomes.filter(|outcome| outcome.onset_ms.is_none()).count(),
        }
    }
}

/// Nearest-rank percentiles 5, 50 and 95.
fn percentiles(mut values: Vec<i64>) -> Option<[i64; 3]> {
    values.sort_unstable();
    let rank = |quantile: f64| ((quantile * values.len() as f64).ceil() as usize).clamp(1, values.len()) - 1;
    (!values.is_empty()).then(|| [0.05, 0.5, 0.95].map(|quantile| values[rank(quantile)]))
}
