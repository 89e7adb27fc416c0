/// The table, the base and the places on it; m, world frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Height of the table top.
    pub table_height: f64,
    /// Centre of the table top.
    pub table_centre: [f64; 2],
    /// Extents of the table top.
    pub table_size: [f64; 2],
    /// Centre of the round base's underside.
    pub platform: [f64; 3],
    /// Its radius.
    pub platform_radius: f64,
    /// Its height.
    pub platform_height: f64,
    /// Where the robot's hand steadies the base.
    pub steady: [f64; 3],
    /// Where parts change hands.
    pub handover: [f64; 3],
    /// Where the person's hand rests.
    pub person_rest: [f64; 3],
    /// The person's shoulder.
    pub person_shoulder: [f64; 3],
    /// Rectangle of each workspace on the table top, by [`Agent::index`](crate::Agent::index): min and max corner.
    pub workspace: [[[f64; 2]; 2]; 2],
    /// How exactly a part must be in its place to be mounted when it is let go.
    pub fit: Fit,
}

/// Tolerances of a socket.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// Largest distance of the part's frame from the socket, m.
    pub position: f64,
    /// Largest angle between the part's own axis and the socket's, rad.
    pub angle: f64,
}

/// Where the robot's eye is: so far behind the world's origin, where the robot stands, and so high above the table top, m.
/// Chosen by hand: it sees both workspaces over the robot's own arm.
const EYE: (f64, f64) = (0.10, 1.05);

impl Scene {
    /// Place of the camera that follows hand and parts: above and behind the robot's head, over the middle of the table.
    pub fn eye(&self) -> [f64; 3] {
        [EYE.0, self.table_centre[1], self.table_height + EYE.1]
    }
}
