use crate::{Input, Message, PortError, Tick};
use coact_messages::Header;

/// A stage with its ports: what a process does once in each period.
pub trait Cycle {
    /// The message that a period's work descends from.
    type Trigger: Message;

    /// The input that the work descends from. The executor waits for it and takes in its newest message.
    fn trigger(&mut self) -> &mut Input<Self::Trigger>;

    /// Advances the stage by one period and publishes; returns the header of the main output.
    ///
    /// Allocates nothing but what each [`Output::loan`](crate::Output::loan) does, and never blocks.
    ///
    /// # Errors
    /// A port that fails ends the process; the supervisor starts another.
    fn step(&mut self, tick: Tick) -> Result<Header, PortError>;

    /// Asked before each cycle once the process is told to stop: whether it may end now. A stage that drives joints brakes
    /// first, and may end when they stand; for a second it gets its cycles.
    fn may_end(&mut self) -> bool {
        true
    }
}
