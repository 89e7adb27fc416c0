use serde::{Deserialize, Serialize};

/// How the arm moved, measured at its joints. Speed and acceleration are means of 10 ms, as fractions of the joint's own
/// limit: of all joints, the largest.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct MotionReport {
    /// Sensor samples that were looked at.
    pub samples: u64,
    /// Sensor samples that the monitor did not see: about them nothing is said here.
    pub unseen: u64,
    /// Largest speed, as a fraction of the limit.
    pub speed: f64,
    /// Where that was.
    pub speed_at: JointMoment,
    /// Largest acceleration, as a fraction of the limit.
    pub acceleration: f64,
    /// Where that was.
    pub acceleration_at: JointMoment,
    /// How far a joint was beyond its limit of position, rad.
    pub beyond_position_rad: f64,
    /// Longest time for which the arm moved on although no good command came, ms: counted from the instant at which the newest
    /// one descended from a sample too old to be used.
    pub on_stale_data_ms: u64,
}

/// A joint of the arm at one time of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct JointMoment {
    /// Number of the joint, from 1 at the shoulder; 0 where there was none.
    pub joint: usize,
    /// Time since the run began, s.
    pub s: f64,
}
