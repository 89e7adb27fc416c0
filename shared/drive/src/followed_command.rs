use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_messages::{Command, Header};
use coact_stage_state::Flag;

/// Which command was followed last: what the next one must come after, and what the joints' motion is part of.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct FollowedCommand {
    pub cycle: u64,
    sequence: u64,
    generation: u64,
    /// Whether it declares a handover.
    pub hands_over: Flag,
    /// Whether there was one.
    exists: Flag,
}

impl FollowedCommand {
    pub fn of(command: &Command) -> Self {
        let Header { cycle, sequence, generation, .. } = command.header;
        Self {
            cycle,
            sequence,
            generation: generation.into(),
            hands_over: Flag::from(command.handover != 0),
            exists: Flag::Set,
        }
    }

    /// Whether a command comes after this one: with no more messages between than cycles, whether it is of the same writer, of its
    /// replacement or of its standby, which count on; or of a replacement that counts anew, which there is only when the writer
    /// `is_silent`.
    pub fn is_before(&self, header: &Header, is_silent: bool) -> bool {
        if !self.exists.is_set() {
            return true;
        }
        let cycles = header.cycle.saturating_sub(self.cycle);
        let messages = header.sequence.saturating_sub(self.sequence);
        let goes_on = (1..=cycles).contains(&messages);
        let replaces = self.generation < header.generation.into() && cycles > 0 && is_silent;
        goes_on || replaces
    }
}
