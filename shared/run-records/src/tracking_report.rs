use serde::{Deserialize, Serialize};

/// How far the arm's joints were from their setpoints, rad: of each command the joint that was furthest off.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[allow(missing_docs, reason = "the names are the percentiles")]
pub struct TrackingReport {
    /// How many commands were looked at.
    pub count: u64,
    pub p50: f64,
    pub p99: f64,
    /// The largest one.
    pub max: f64,
}
