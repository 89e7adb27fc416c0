use crate::grip_height;
use nalgebra::{Isometry3, Point3, Vector3};

/// Where the hand goes: a place for the grasp point, a direction of approach, and what is left free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HandGoal {
    /// Place of the grasp point, m, world.
    pub point: Point3<f64>,
    /// Direction in which the hand approaches, unit, world.
    pub approach: Vector3<f64>,
    /// Direction of the closing axis at roll 0, world.
    pub closing_axis: Vector3<f64>,
    /// How many rolls about the approach serve equally, evenly spaced: 2 for something with two flat sides; 0 for any roll.
    pub rolls: u32,
    /// Direction of the last part of the movement, unit, world: that of the approach or, where the held part goes into a
    /// place, the direction into it.
    pub along: Vector3<f64>,
    /// Length of that last part, from the pose before it (pre-grasp, pre-place), m.
    pub back: f64,
    /// Height above which shoulder, elbow and wrist stay, m, world.
    pub floor: f64,
}

impl HandGoal {
    /// Goal for gripping, or placing, an upright or lying part: `frame` is that of the part (centre of its underside,
    /// its z axis points out of its socket), `height` its height, m. The hand comes from the top of the part.
    pub fn grip(frame: &Isometry3<f64>, height: f64, rolls: u32, back: f64, floor: f64) -> Self {
        let point = frame * Point3::new(0.0, 0.0, grip_height(height));
        let approach = frame.rotation * -Vector3::z();
        let closing_axis = frame.rotation * Vector3::x();
        Self { point, approach, closing_axis, rolls, along: approach, back, floor }
    }

    /// Goal for gripping an upright part from its side: as [`HandGoal::grip`], but the hand comes across the part's z
    /// axis, from where `turn` rad about that axis points, and closes across it.
    pub fn grip_from_side(frame: &Isometry3<f64>, height: f64, turn: f64, back: f64) -> Self {
        let point = frame * Point3::new(0.0, 0.0, grip_height(height));
        let approach = frame.rotation * -Vector3::new(turn.cos(), turn.sin(), 0.0);
        let closing_axis = frame.rotation * Vector3::new(-turn.sin(), turn.cos(), 0.0);
        Self { point, approach, closing_axis, rolls: 2, along: approach, back, floor: f64::NEG_INFINITY }
    }
}
