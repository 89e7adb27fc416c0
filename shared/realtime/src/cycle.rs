use crate::{Input, Message, PortError};
use coact_messages::Header;

/// One period of one process.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tick {
    /// Its number, counted from the start of the run.
    pub cycle: u64,
    /// Its release, ns of `CLOCK_MONOTONIC`.
    pub released_ns: u64,
    /// When this process started on it, ns of `CLOCK_MONOTONIC`.
    pub started_ns: u64,
}

/// A stage with its ports: what a process does once in each period.
pub trait Cycle {
    /// The message that a period's work descends from.
    type Trigger: Message;

    /// The input that the work descends from. The executor waits on it and takes in its newest message.
    fn trigger(&mut self) -> &mut Input<Self::Trigger>;

    /// Advances the stage by one period and publishes; answers the header of the main output.
    ///
    /// Allocates nothing but what each [`Output::loan`](crate::Output::loan) does, and never blocks.
    ///
    /// # Errors
    /// A port that fails ends the process; the supervisor starts another.
    fn step(&mut self, tick: Tick) -> Result<Header, PortError>;
}
