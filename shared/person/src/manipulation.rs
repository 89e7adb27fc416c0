use glam::{DQuat, DVec3};

/// What the person's hand did to the parts in one tick, in this order.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Manipulation {
    /// The part on which the fingers have closed, or which they have from the robot now.
    pub grasped: Option<usize>,
    /// The part that was carried, with its position, m, and its orientation.
    pub moved: Option<(usize, DVec3, DQuat)>,
    /// The part from which the fingers have opened.
    pub released: Option<usize>,
}
