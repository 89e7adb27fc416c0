use crate::Record;
use serde::{Deserialize, Serialize};

/// Joints of the robot's arm and hand.
pub const JOINTS: usize = 15;
/// Keypoints of the person's arm and hand.
pub const KEYPOINTS: usize = 9;

/// One line of the snapshot log, `snapshots.jsonl`: what the scene looked like at one instant.
///
/// One is taken whenever a part changed hands or came into its place. Joints, parts and keypoints are what the sensors
/// saw. Lengths in m, angles in rad, world frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Snapshot {
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
    /// Angles of the robot's joints, in the order of the messages: arm, then hand.
    pub joints: [f64; JOINTS],
    /// The parts that were recognised.
    pub parts: Vec<SeenPart>,
    /// Keypoints of the person's right arm and hand, then of the left ones, in the order of `coact_messages::KeypointName`; none for
    /// one that was not seen.
    pub keypoints: [[Option<[f64; 3]>; KEYPOINTS]; 2],
}

impl Record for Snapshot {
    const FILE: &'static str = "snapshots.jsonl";
}

/// A recognised part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct SeenPart {
    /// Name of its kind.
    pub kind: String,
    /// Origin of its frame.
    pub position: [f64; 3],
    /// Orientation of that frame, quaternion x, y, z, w.
    pub orientation: [f64; 4],
}
