use crate::robot_hand_state::RobotHandState;
use crate::sensors::TrackerState;
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_drive::DriveState;
use coact_messages::{Flaw, Heard, MAX_PARTS, SceneView};
use coact_person::PersonState;
use coact_stage_state::{Flag, Implausible, StageState, ensure};

/// The world's state beside joints and parts: the opaque words of [`WorldState`](coact_messages::WorldState).
///
/// Random generators need none: their numbers depend on seed and tick alone.
#[repr(C)]
#[derive(Debug, Clone, Copy, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct SimulationState {
    /// Tick of the last step.
    pub tick: u64,
    /// Whether a step was made.
    pub started: Flag,
    /// Tick since which the assembly has been complete; 0 while it is not.
    pub complete_since: u64,
    /// Completed assemblies before the present one.
    pub assemblies: u64,
    /// Cycles for which each part has lain where nobody can take it from.
    pub stray: [u64; MAX_PARTS],
    pub person: PersonState,
    pub robot: RobotHandState,
    pub drive: DriveState,
    pub right_tracker: TrackerState,
    pub left_tracker: TrackerState,
    /// The recogniser's newest frame.
    pub scene: SceneView,
    /// Bit i set: the scene's i-th slip has happened.
    pub slipped: u64,
    /// What the person said last.
    pub heard: Heard,
}

impl StageState for SimulationState {
    const STAGE: &'static str = "world";
    const LAYOUT: u32 = 8;

    fn check(&self) -> Result<(), Implausible> {
        let counts = [self.assemblies, self.scene.frame, self.heard.sentences, self.tick >> 16];
        let counts = counts.iter().chain(&self.stray).all(|count| *count <= u64::from(u32::MAX));
        ensure(counts, "tick or count", "one that can be reached in a run")?;
        let complete = self.complete_since <= self.tick.max(1);
        ensure(complete, "complete_since", "a tick that has been")?;
        let [right, left] = self.trackers();
        let frames =
            [self.scene.captured_cycle, right.delivered.captured_cycle, left.delivered.captured_cycle];
        ensure(frames.iter().all(|cycle| *cycle <= self.tick), "captured_cycle", "a tick that has been")?;
        let views = self
            .scene
            .check()
            .and_then(|()| self.trackers().into_iter().try_for_each(TrackerState::check_views));
        views.map_err(|Flaw { field, expected }| Implausible { field, expected })?;
        self.drive.check()?;
        self.trackers().into_iter().try_for_each(TrackerState::check)
    }
}

impl SimulationState {
    /// By [`ArmSide`](coact_messages::ArmSide).
    pub fn trackers(&self) -> [&TrackerState; 2] {
        [&self.right_tracker, &self.left_tracker]
    }
}
