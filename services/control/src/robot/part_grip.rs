use coact_robot::{Grip, HAND_JOINTS};

/// One way in which the hand can grasp a kind of part.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PartGrip {
    pub kind: usize,
    pub grip: Grip,
    /// Angles of the joints of the hand that is closed on it, and of one that has let it go, rad.
    pub closed: [f64; HAND_JOINTS],
    pub open: [f64; HAND_JOINTS],
}
