/// Size of the cube that was reached for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Size {
    /// 2.5 cm.
    Small = 0,
    /// 5.5 cm.
    Medium = 1,
    /// 7.5 cm.
    Large = 2,
}

impl Size {
    /// All sizes, ascending.
    pub const ALL: [Self; 3] = [Self::Small, Self::Medium, Self::Large];

    /// Edge length of the cube, m.
    pub fn width(self) -> f64 {
        [0.025, 0.055, 0.075][self as usize]
    }

    /// 0 for small, 1 for medium, 2 for large.
    pub fn index(self) -> usize {
        self as usize
    }
}

/// One joint in one frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ImagePoint {
    /// Column, pixels, to the right.
    pub x: f64,
    /// Row, pixels, downwards.
    pub y: f64,
    /// The detector's confidence: 0 = lost; some detectors report a little more than 1.
    pub confidence: f64,
}

/// One frame of the camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Time since reach onset, s.
    pub time: f64,
    /// Joints in the order of [`JOINTS`](crate::JOINTS).
    pub joints: [ImagePoint; 9],
}

/// One recorded reach-to-grasp movement, with half a second before and some time after it.
#[derive(Debug, Clone, PartialEq)]
pub struct Reach {
    /// Number of the person.
    pub participant: u32,
    /// Label: size of the object.
    pub size: Size,
    /// Number of the trial: trials of different sizes with the same number were made at about the same time.
    pub trial: u32,
    /// Label: time from onset to the end of the grasp, s.
    pub movement_time: f64,
    /// Frames in the order of time.
    pub frames: Vec<Frame>,
}
