use coact_messages::KeypointName;

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

/// Length of one person's forearm in the image, pixels: the median of how it is first seen in each reach, at rest. `None` where it never is.
///
/// It tells the image's scale: how far the person sat from the camera, nobody wrote down.
pub fn forearm(reaches: &[&Reach]) -> Option<f64> {
    let first = |reach: &&Reach| reach.frames.iter().find_map(forearm_in);
    let mut lengths: Vec<f64> = reaches.iter().filter_map(first).collect();
    lengths.sort_unstable_by(f64::total_cmp);
    lengths.get(lengths.len() / 2).copied().filter(|length| *length > 1.0)
}

fn forearm_in(frame: &Frame) -> Option<f64> {
    let [elbow, wrist] = [KeypointName::Elbow, KeypointName::Wrist].map(|joint| frame.joints[joint as usize]);
    let found = elbow.confidence > 0.0 && wrist.confidence > 0.0;
    found.then(|| (elbow.x - wrist.x).hypot(elbow.y - wrist.y))
}
