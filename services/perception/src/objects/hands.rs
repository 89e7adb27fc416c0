use nalgebra::{Isometry3, Vector3};

/// What perception knows at this instant of both hands, either of which may hold a part.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hands {
    /// The person's hand, while it is tracked.
    pub person: Option<PersonHand>,
    /// Whether it was tracked once, and is not now: what its fingers do is not seen.
    pub unseen: bool,
    /// Whether it has been tracked for so long that what it does is known.
    pub followed: bool,
    /// The robot's palm, when its kinematics are known.
    pub palm: Option<Isometry3<f64>>,
    /// The middle of the robot's hand, from its palm to its grasp point, m, when its kinematics are known.
    pub hand_axis: Option<[Vector3<f64>; 2]>,
    /// Force at the robot's finger tips, N.
    pub touch: f64,
}

/// The person's hand.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PersonHand {
    /// Middle between thumb and index tip, m.
    pub centre: Vector3<f64>,
    /// Distance of thumb and index tip, m.
    pub aperture: f64,
    /// Wrist speed, m/s.
    pub speed: f64,
    /// Velocity of the centre, m/s: so does what it holds move.
    pub velocity: Vector3<f64>,
    /// Whether it lies where it rests.
    pub rests: bool,
}
