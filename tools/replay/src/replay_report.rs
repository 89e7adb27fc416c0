use crate::Difference;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// What became of a replay.
#[derive(Debug, Clone, Serialize)]
pub struct ReplayReport {
    /// The recording.
    pub recording: PathBuf,
    /// Whether each message that was compared is what was recorded, to the bit.
    pub equal: bool,
    /// Whether this program was built of the code that recorded. If not, differences may come from that.
    pub same_code: bool,
    /// Version of the program that recorded.
    pub version: String,
    /// The file ends in the middle: its recorder was killed.
    pub truncated: bool,
    /// Messages that the recorder has lost, by topic; unknown in a file without an end.
    pub lost: Option<BTreeMap<String, u64>>,
    /// First and last cycle of the recorded sensor samples.
    pub cycles: Option<(u64, u64)>,
    /// Perception.
    pub percepts: StageReport,
    /// Fields, with the decision in each frame.
    pub frames: StageReport,
    /// Decisions in the frames that were compared: changes from one action to another.
    pub decisions: u64,
}

/// What became of one stage's messages.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct StageReport {
    /// Messages that were computed again.
    pub computed: u64,
    /// Of these, recorded and therefore compared.
    pub compared: u64,
    /// Of these, not what was recorded.
    pub differing: u64,
    /// Recorded, and not compared: the state or the input that they came from is not in the recording.
    pub not_compared: u64,
    /// How often the stage went on from a recorded message, because what it was computed from is not in the recording.
    pub resumed: u64,
    /// The first message that is not what was recorded.
    pub first_difference: Option<Difference>,
}
