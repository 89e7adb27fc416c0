use crate::statistics::Estimate;
use crate::{Fluency, Trial};
use serde::Serialize;

/// One network variant against another with the same partners. Pairs are those seeds whose assembly both completed; a
/// ratio is that of the means, with its paired bootstrap interval.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// Pairs.
    pub pairs: usize,
    /// Functional delay, the one's against the other's; none where the other's is not above 0.
    pub functional_delay_ratio: Option<Estimate>,
    /// Functional delay, the one's minus the other's, as a fraction of the task time.
    pub functional_delay_difference: Option<Estimate>,
    /// Functional delay of dependent turns (see [`Trial::answer_delay_ms`]), the one's against the other's; below 0 where
    /// the one begins before the turn is over.
    pub answer_delay_ratio: Option<Estimate>,
    /// How long the person waits for the robot within actions, the one's against the other's.
    pub waiting_ratio: Option<Estimate>,
    /// Task time, the one's against the other's.
    pub time_ratio: Option<Estimate>,
}

impl Comparison {
    /// Compares `one` with the `other`.
    pub fn new(one: &[Trial], other: &[Trial]) -> Self {
        let partner = |trial: &Trial| other.iter().find(|rival| rival.seed == trial.seed);
        let both = one.iter().filter_map(|trial| Some((trial, partner(trial)?)));
        let pairs: Vec<(&Trial, &Trial)> = both
            .filter(|(trial, rival)| trial.completed_ms.is_some() && rival.completed_ms.is_some())
            .collect();
        let metrics = |metric: &dyn Fn(&Trial) -> f64| -> Vec<(f64, f64)> {
            pairs.iter().map(|(trial, rival)| (metric(trial), metric(rival))).collect()
        };
        let fluency = |metric: fn(&Fluency) -> f64| metrics(&|trial| metric(&trial.fluency));
        let delays = fluency(|fluency| fluency.functional_delay);
        let differences: Vec<f64> = delays.iter().map(|(one, other)| one - other).collect();
        let waits = |trial: &Trial| trial.fluency.human_waits * trial.ended_ms as f64;
        Self {
            pairs: pairs.len(),
            functional_delay_ratio: Estimate::ratio(&delays),
            functional_delay_difference: Estimate::mean(&differences),
            answer_delay_ratio: Estimate::ratio(&metrics(&Trial::answer_delay_ms)),
            waiting_ratio: Estimate::ratio(&metrics(&waits)),
            time_ratio: Estimate::ratio(&metrics(&|trial| trial.ended_ms as f64)),
        }
    }
}
