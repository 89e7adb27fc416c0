use coact_run_records::SeparationReport;
use serde::Serialize;

/// What came of one encounter: the robot works while a recorded arm moves in its workspace.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Encounter {
    /// The recording, by its folder and file.
    pub recording: String,
    /// Which arm: left or right.
    pub arm: &'static str,
    /// Seed of the arm's place, the robot's work and the sensors' noise.
    pub seed: u64,
    /// Time in which the robot's arm moved, ms.
    pub moved_ms: u64,
    /// Time in which a handover was declared, ms: nothing else but speeds is counted in it.
    pub handover_ms: u64,
    /// How near robot and person came.
    pub separation: SeparationReport,
}

impl Encounter {
    /// Whether the robot moved in it at all, for half a second or longer: an arm that only stands closes on nobody.
    pub fn robot_moved(&self) -> bool {
        self.moved_ms >= 500
    }
}
