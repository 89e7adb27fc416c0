use crate::configuration::shipped;
use coact_lockstep::Lockstep;
use coact_messages::{Command, FieldFrame, Percept, SensorSample, Truth, WorldState};
use coact_pipeline::{RunSettings, WorldMode};
use std::sync::LazyLock;

/// All messages of one cycle of a run.
pub(crate) struct Instant {
    pub(crate) tick: u64,
    pub(crate) sample: Box<SensorSample>,
    pub(crate) percept: Box<Percept>,
    pub(crate) frame: Box<FieldFrame>,
    pub(crate) command: Box<Command>,
    pub(crate) truth: Box<Truth>,
    pub(crate) state: Box<WorldState>,
}

/// What the instants are taken from.
pub(crate) fn settings() -> RunSettings {
    RunSettings { world: WorldMode::Kinematic, ..RunSettings::shipped(&shipped("")) }
}

/// When they are taken, cycles: before anything was decided, while the person reaches, while the arm moves, and with a part
/// in the robot's hand.
const TAKEN: [u64; 4] = [100, 1500, 5000, 7000];

/// Some instants of an assembly in lockstep: good messages, to be changed.
pub(crate) static INSTANTS: LazyLock<Vec<Instant>> = LazyLock::new(|| {
    let mut stages = Lockstep::new(&settings()).unwrap();
    TAKEN
        .map(|tick| {
            while stages.ticks() <= tick {
                stages.step();
            }
            Instant {
                tick,
                sample: stages.sample.clone(),
                percept: stages.percept.clone(),
                frame: stages.frame.clone(),
                command: stages.command.clone(),
                truth: stages.truth.clone(),
                state: stages.state.clone(),
            }
        })
        .into()
});
