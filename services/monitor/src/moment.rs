/// One line of `album.jsonl`: how hands and parts were, as the sensors saw them, when something had changed.
///
/// Lengths in m, angles in rad, world frame.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Moment {
    /// When, ms from the start of the run.
    pub at_ms: u64,
    /// What had changed.
    pub what: String,
    /// Name of the robot's action.
    pub robot_does: Option<String>,
    /// Name of the person's chain, and of the kind of part.
    pub person_does: Option<String>,
    /// Names of the kinds of part in the robot's hand.
    pub robot_holds: Vec<String>,
    /// Names of the kinds of part in the person's hand.
    pub person_holds: Vec<String>,
    /// Names of the subgoals whose parts are in their places.
    pub in_place: Vec<String>,
    /// Joints of the robot's arm and hand, in message order.
    pub joints: [f64; coact_messages::JOINTS],
    /// The parts that were recognised.
    pub parts: Vec<SeenPart>,
    /// Joints of the person's arm and hand, in the order of [`coact_messages::KeypointName`]; none for one that was lost.
    pub keypoints: [Option<[f64; 3]>; 9],
}

/// A recognised part.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct SeenPart {
    /// Name of its kind.
    pub kind: String,
    /// Place of its frame.
    pub position: [f64; 3],
    /// Orientation of that frame, quaternion x, y, z, w.
    pub orientation: [f64; 4],
}
