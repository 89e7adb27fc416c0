use crate::monotonic_clock::now;
use crate::{Input, Loan, Message, Output, PortError, Tick};
use coact_messages::Header;
use std::time::Duration;

/// How long a standby waits, from when its input came, for its stage's message. Chosen by hand: two to three times what a stage
/// computes, and short enough that the next one still gets the standby's message in the same cycle.
const PATIENCE: Duration = Duration::from_micros(150);
/// How often it looks meanwhile. Chosen by hand: each look takes some microseconds from the stage, which shares its core.
const LOOK_EVERY: Duration = Duration::from_micros(75);

/// The output of a stage that may have a standby. Both go on from the newest message of their topic, whoever sent it, and
/// each sends only for cycles for which the other has not: so nobody has to notice that a stage died, and nothing is taken over.
///
/// Should both send for one cycle, their readers take the first message, and both go on from the one that they took.
#[derive(Debug)]
pub struct StandIn<T: Message> {
    newest: Input<T>,
    output: Output<T>,
    waits: bool,
}

impl<T: Message> StandIn<T> {
    /// Of a stage, or of the standby that `waits` for it.
    pub(crate) fn new(newest: Input<T>, output: Output<T>, waits: bool) -> Self {
        Self { newest, output, waits }
    }

    /// The header of the message of this cycle, if the other one has sent it, for this process's pulse. A standby gives its stage some time for that.
    ///
    /// # Errors
    /// As [`Input::refresh`].
    pub fn sent_by_other(&mut self, tick: Tick) -> Result<Option<Header>, PortError> {
        let patience = if self.waits { PATIENCE } else { Duration::ZERO };
        while !self.has(tick.cycle)? && now() < tick.started_ns + patience.as_nanos() as u64 {
            // An event for the standby would cost the stage time in each cycle; this costs the standby some where the stage is
            // on another core.
            std::thread::sleep(LOOK_EVERY);
        }
        // The pulse that tells of this cycle is this process's own, and of nothing before the cycle began.
        let generation = self.output.generation;
        let sent = self.newest.header().filter(|header| header.cycle >= tick.cycle);
        Ok(sent.map(|header| Header {
            generation,
            published_ns: header.published_ns.max(tick.started_ns),
            ..*header
        }))
    }

    /// Whether the message of `cycle`, or a later one, has come.
    fn has(&mut self, cycle: u64) -> Result<bool, PortError> {
        self.newest.refresh()?;
        Ok(self.newest.header().is_some_and(|header| header.cycle >= cycle))
    }

    /// The newest message, and the memory of the next one; none before there was any.
    ///
    /// # Errors
    /// As [`Output::loan`].
    pub fn prepare(&mut self) -> Result<(Option<&T>, Loan<'_, T>), PortError> {
        let Self { newest, output, .. } = self;
        if let Some(newest) = newest.header() {
            output.continue_after(newest);
        }
        Ok((newest.latest(), output.loan()?))
    }

    /// The output, to be resumed from a checkpoint.
    pub fn output(&mut self) -> &mut Output<T> {
        &mut self.output
    }
}
