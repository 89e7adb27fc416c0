use crate::{Input, Loan, Message, Output, PortError, Tick};
use coact_messages::Header;
use std::time::Duration;

/// How long a standby waits for its stage's message before it looks whether that has come. Chosen by hand: some four times what a stage
/// computes, and short enough that the next one still gets the standby's message in the same cycle. It looks once: it stands above its
/// stage, on the same core, and each look takes some ten microseconds from that. With one each 75 µs, and a patience of 150, three times as
/// many commands were late in runs without any fault (180 to 543 of 12 000 instead of 41 to 104, three runs of each in turn).
const PATIENCE: Duration = Duration::from_micros(200);

/// After so many cycles in a row without its stage's message a standby takes it for dead, and waits only once in [`HURRIES_FOR`] cycles, for
/// a replacement is there within some ten: while it waited in each of them, up to 7 of the 15 to 60 cycles in which control
/// recovered on a slow machine went without a command. Both chosen by hand: one cycle is often the machine's.
const TAKEN_FOR_DEAD: u32 = 2;
const HURRIES_FOR: u32 = 8;

/// The output of a stage that may have a standby. Both go on from the newest message of their topic, whoever sent it, and
/// each sends only for cycles for which the other has not: so nobody has to notice that a stage died, and nothing is taken over.
///
/// Should both send for one cycle, their readers take the first message, and both go on from the one that they took.
#[derive(Debug)]
pub struct StandIn<T: Message> {
    newest: Input<T>,
    output: Output<T>,
    waits: bool,
    /// Cycles in a row in which the other one had sent nothing when this one looked.
    silent: u32,
}

impl<T: Message> StandIn<T> {
    /// Of a stage, or of the standby that `waits` for it.
    pub(crate) fn new(newest: Input<T>, output: Output<T>, waits: bool) -> Self {
        Self { newest, output, waits, silent: 0 }
    }

    /// The header of the message of this cycle, if the other one has sent it, for this process's pulse. A standby gives its stage some time
    /// for that, while it lives.
    ///
    /// # Errors
    /// As [`Input::refresh`].
    pub fn sent_by_other(&mut self, tick: Tick) -> Result<Option<Header>, PortError> {
        let is_dead = self.silent >= TAKEN_FOR_DEAD && !self.silent.is_multiple_of(HURRIES_FOR);
        let mut has_sent = self.has(tick.cycle)?;
        if !has_sent && self.waits && !is_dead {
            // An event for the standby would cost the stage time in each cycle; this costs the standby some where the stage is
            // on another core.
            std::thread::sleep(PATIENCE);
            has_sent = self.has(tick.cycle)?;
        }
        self.silent = if has_sent { 0 } else { self.silent.wrapping_add(1) };
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
