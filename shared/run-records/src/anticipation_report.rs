use crate::{ActionEvent, Event};
use serde::{Deserialize, Serialize};

/// Whether decisions came in time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct AnticipationReport {
    /// The partner's actions to which an answer was expected.
    pub actions: usize,
    /// Those about which something was decided before grasp completion.
    pub decided_before_grasp: usize,
    /// Those of them that were decided rightly.
    pub correct: usize,
    /// Decision lead of all actions that were answered rightly, late ones included.
    pub lead_ms: LeadPercentiles,
    /// Every action.
    pub events: Vec<ActionEvent>,
}

/// Decision leads, ms; negative ones came too late; null without any.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[allow(missing_docs, reason = "the names are the percentiles")]
pub struct LeadPercentiles {
    pub p5: Option<i64>,
    pub p50: Option<i64>,
    pub p95: Option<i64>,
}

impl AnticipationReport {
    /// From the events of a run.
    pub fn new(events: &[Event]) -> Self {
        let actions: Vec<ActionEvent> = events.iter().filter_map(Event::as_action).cloned().collect();
        let expected = || actions.iter().filter(|action| action.expected.is_some());
        let mut leads: Vec<i64> =
            expected().filter(|action| action.correct).filter_map(|action| action.lead_ms).collect();
        leads.sort_unstable();
        Self {
            actions: expected().count(),
            decided_before_grasp: expected().filter(|action| action.decided_before_grasp()).count(),
            correct: expected().filter(|action| action.anticipated()).count(),
            lead_ms: LeadPercentiles::of(&leads),
            events: actions,
        }
    }
}

impl LeadPercentiles {
    /// Of leads in ascending order, by nearest rank.
    fn of(sorted: &[i64]) -> Self {
        let rank = |fraction: f64| ((fraction * sorted.len() as f64).ceil() as usize).max(1) - 1;
        let at = |fraction| sorted.get(rank(fraction)).copied();
        Self { p5: at(0.05), p50: at(0.5), p95: at(0.95) }
    }
}
