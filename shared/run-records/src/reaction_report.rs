use serde::{Deserialize, Serialize};

/// How long after a decision the movement for it begins, ms: the first command that it changes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[allow(missing_docs, reason = "the names are the percentiles")]
pub struct ReactionReport {
    /// Movements that a decision began.
    pub count: u64,
    pub p50: u64,
    pub p99: u64,
    /// The longest one.
    pub max: u64,
}
