use crate::MotionState;
use nalgebra::{Isometry3, UnitQuaternion, UnitVector3};

/// One revolute joint of a kinematic chain.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Its name in the URDF.
    pub name: String,
    /// Pose of the joint frame, at angle zero, in the frame of the joint before it (fixed joints are folded in), m.
    pub origin: Isometry3<f64>,
    /// Axis of rotation in the joint frame.
    pub axis: UnitVector3<f64>,
    /// Limits.
    pub limits: JointLimits,
}

/// Limits of one joint; rad and s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointLimits {
    /// Smallest position, rad.
    pub lower: f64,
    /// Largest position, rad.
    pub upper: f64,
    /// Largest speed, rad/s.
    pub velocity: f64,
    /// Largest torque, Nm.
    pub effort: f64,
    /// Largest acceleration, rad/s².
    pub acceleration: f64,
    /// Largest jerk, rad/s³.
    pub jerk: f64,
}

/// Rounding of a position that still counts as within its limits, rad.
const ROUNDING: f64 = 1e-9;

impl Joint {
    /// Pose of the joint's link in the frame of the joint before it, at `angle` rad.
    pub fn transform(&self, angle: f64) -> Isometry3<f64> {
        self.origin * UnitQuaternion::from_axis_angle(&self.axis, angle)
    }
}

impl JointLimits {
    /// Whether `angle` lies within the position limits, shrunk on both ends by `margin` rad.
    pub fn contain(&self, angle: f64, margin: f64) -> bool {
        angle >= self.lower + margin && angle <= self.upper - margin
    }

    /// Whether position (but for rounding), velocity, acceleration and `jerk` (rad/s³) lie within the limits.
    pub fn allows(&self, state: &MotionState, jerk: f64) -> bool {
        self.contain(state.position, -ROUNDING)
            && state.velocity.abs() <= self.velocity
            && state.acceleration.abs() <= self.acceleration
            && jerk.abs() <= self.jerk
    }
}
