use coact_robot::Posture;

/// A link near something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Proximity {
    /// Index of the link in the collision model.
    pub link: usize,
    /// What it is near to.
    pub other: Counterpart,
    /// Distance of the surfaces, m; negative when they overlap.
    pub distance: f64,
    /// Gradient of the distance by the arm's joints, m/rad.
    pub gradient: Posture,
}

/// What a link is near to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Counterpart {
    /// An obstacle, by its index in the scene.
    Obstacle(usize),
    /// Another link of the same collision model.
    Link(usize),
}
