use serde::{Deserialize, Serialize};

/// How near robot and person came, by what really happened. Handovers, in which hands touch, are left out of all but the
/// first and the last two numbers.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct SeparationReport {
    /// Ticks that were measured.
    pub ticks: u64,
    /// Smallest distance, m; none when nobody was there.
    pub nearest_m: Option<f64>,
    /// Smallest margin, m: distance of a link that closes by its own motion from a limb, less what ISO/TS 15066 asks for at the speeds of
    /// both. Below 0 the robot might not stand in time; none when it closed on nobody. Contact apart.
    #[serde(default)]
    pub smallest_margin_m: Option<f64>,
    /// Time in which some link and some limb were nearer to each other than the protective separation, but did not touch, and the link came
    /// nearer by its own motion, ms. None is allowed.
    pub robot_closing_ms: u64,
    /// The same by the person's own motion.
    pub person_closing_ms: u64,
    /// Time in which their bounding capsules touched, ms, and the greatest speed of what touched of the robot, m/s.
    #[serde(default)]
    pub contact_ms: u64,
    /// See `contact_ms`.
    #[serde(default)]
    pub contact_speed_mps: f64,
    /// Time in which the arm was held back below its planned speed, and stopped, ms.
    pub held_back_ms: u64,
    /// See `held_back_ms`.
    pub stopped_ms: u64,
}
