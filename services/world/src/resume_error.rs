use coact_stage_state::{Implausible, StateError};

/// Why a world does not go on from the state of its predecessor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum ResumeError {
    /// It built something else.
    #[error("the state belongs to task {found:#018x}; expected that of {expected:#018x}, start without it")]
    OtherTask {
        /// Fingerprint of the task in the message.
        found: u64,
        /// That of the own task.
        expected: u64,
    },
    /// Its words are no state of a world.
    #[error(transparent)]
    State(#[from] StateError),
    /// A joint, a part or the person is where it cannot be.
    #[error("the state does not fit the task: {0}; the message is damaged, start without it")]
    Implausible(#[from] Implausible),
}
