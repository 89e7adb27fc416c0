use crate::robot_hand_state::RobotHandState;
use crate::sensors::TrackerState;
use bytemuck::{Pod, Zeroable};
use coact_messages::{Heard, MAX_PARTS, SceneView, WorldState};
use coact_person::PersonState;

/// Everything that a world remembers beside joints and parts: the opaque words of [`WorldState`].
///
/// Random generators need none: their numbers depend on seed and tick alone.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub(crate) struct SimulationState {
    /// Tick of the last step.
    pub tick: u64,
    /// 1 once a step was made.
    pub started: u64,
    /// Tick since which the assembly has been complete; 0 while it is not.
    pub complete_since: u64,
    /// Completed assemblies before the present one.
    pub assemblies: u64,
    /// Ticks for which each part has lain where nobody can take it from.
    pub stray: [u64; MAX_PARTS],
    pub person: PersonState,
    pub robot: RobotHandState,
    pub tracker: TrackerState,
    pub scene: SceneFrame,
    /// Bit i set: the scene's i-th slip has happened.
    pub slipped: u64,
    /// What the person said last.
    pub heard: HeardSentence,
}

/// The newest sentence.
#[repr(transparent)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct HeardSentence(pub Heard);

impl PartialEq for HeardSentence {
    fn eq(&self, other: &Self) -> bool {
        bytemuck::bytes_of(self) == bytemuck::bytes_of(other)
    }
}

/// The recogniser's newest frame.
#[repr(transparent)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct SceneFrame(pub SceneView);

impl PartialEq for SceneFrame {
    fn eq(&self, other: &Self) -> bool {
        bytemuck::bytes_of(self) == bytemuck::bytes_of(other)
    }
}

const WORDS: usize = size_of::<SimulationState>() / 8;
const _: () = assert!(
    size_of::<SimulationState>().is_multiple_of(8) && WORDS <= 768,
    "memory outgrew WorldState::memory"
);

impl SimulationState {
    pub fn save(&self, state: &mut WorldState) {
        state.memory[..WORDS].copy_from_slice(bytemuck::cast_slice(std::slice::from_ref(self)));
        state.memory[WORDS..].fill(0.0);
    }

    pub fn load(state: &WorldState) -> Self {
        let mut memory = Self::zeroed();
        bytemuck::cast_slice_mut(std::slice::from_mut(&mut memory)).copy_from_slice(&state.memory[..WORDS]);
        memory
    }
}
