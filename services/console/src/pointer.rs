use serde::Deserialize;

/// Where somebody points on the table, and what the hand there is to do. No part and no intention is named: what is under the hand is
/// what it comes to.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pointer {
    /// Place on the table, m, world frame.
    pub x: f64,
    /// See `x`.
    pub y: f64,
    /// How much higher than usual, m.
    #[serde(default)]
    pub lift: f64,
    /// Whether the fingers close.
    #[serde(default)]
    pub pressed: bool,
    /// The grip with which the hand reaches: index in the task's list.
    #[serde(default)]
    pub grip: usize,
    /// The gesture that the open hand shows, held out where it is: index in the task's list.
    #[serde(default)]
    pub gesture: Option<usize>,
    /// Whether the hand stays back and points there with its index finger.
    #[serde(default)]
    pub pointing: bool,
}
