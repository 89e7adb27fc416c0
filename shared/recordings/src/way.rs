use crate::{ArmSide, WayKind};

/// How a hand of a real person went from one place to another, apart from where these places were and how far apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Way {
    /// What the hand did.
    pub kind: WayKind,
    /// The recording, as its folder and name: `CollaborativeStacking/0`.
    pub recording: String,
    /// Which hand.
    pub hand: ArmSide,
    /// First and last frame of the recording, from 0.
    pub frames: [u32; 2],
    /// From its beginning to its end, straight, m.
    pub distance: f64,
    /// How long it took, s.
    pub duration: f64,
    /// Where the hand was at equal fractions of that time, in units of the distance: along the straight line, aside from it
    /// (horizontally, to the right of who looks along it; a left hand's is mirrored, as if it were a right one's), and up from
    /// it. From exactly 0, 0, 0 to exactly 1, 0, 0.
    pub points: [[f64; 3]; Way::POINTS],
}

impl Way {
    /// How many points a way has: 32 intervals of some 30 ms, in which no recorded hand changed its speed by much.
    pub const POINTS: usize = 33;
    /// Where each begins, in units of the distance.
    pub const BEGINNING: [f64; 3] = [0.0, 0.0, 0.0];
    /// Where each ends.
    pub const END: [f64; 3] = [1.0, 0.0, 0.0];
}
