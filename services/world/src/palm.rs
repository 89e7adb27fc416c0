use glam::{DQuat, DVec3};

/// The robot's hand as anybody can see it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Palm {
    /// Where the finger ends meet, m.
    pub grasp_point: DVec3,
    pub orientation: DQuat,
    /// Mean angle of the finger bases, rad; growing angles close.
    pub finger_closure: f64,
}
