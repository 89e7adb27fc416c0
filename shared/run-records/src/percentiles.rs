use serde::{Deserialize, Serialize};

/// A histogram of durations in short, ns.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[allow(missing_docs, reason = "the names are the percentiles")]
pub struct Percentiles {
    /// How many durations were recorded.
    pub count: u64,
    pub p50: u64,
    pub p99: u64,
    pub p999: u64,
    /// The longest one.
    pub max: u64,
}
