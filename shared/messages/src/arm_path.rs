use crate::ARM_JOINTS;
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// The path that the arm follows, with its timing, and how far the arm has come on it.
///
/// Between two knots each joint moves along the polynomial of fifth degree that joins their states (`coact_robot::Knot`
/// has this layout).
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable, ZeroCopySend)]
pub struct ArmPath {
    /// The knots, the first `count` of them, in the order of their times.
    pub knots: [PathKnot; ArmPath::KNOTS],
    /// How many there are; 0: no path.
    pub count: u64,
    /// How far the arm has come: time of the path, s.
    pub elapsed: f64,
    /// Fraction of the planned speed at which it goes on, 0 to 1.
    pub speed_override: f64,
    /// Change of that, 1/s.
    pub override_rate: f64,
    /// The shortest time in which the path could be followed under the limits of speed and acceleration, whatever the jerk, s; 0: not known.
    pub shortest: f64,
    /// 1 while the arm's setpoints lie on the path, 0 when it has left it: the joints brake each for itself.
    pub followed: u64,
}

/// State of the arm at an instant of a path.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable, ZeroCopySend)]
pub struct PathKnot {
    /// Time since the start of the path, s.
    pub t: f64,
    /// Position, velocity and acceleration of each joint; rad, rad/s, rad/s².
    pub states: [[f64; 3]; ARM_JOINTS],
}

impl ArmPath {
    /// Most knots of a path.
    pub const KNOTS: usize = 32;
}
