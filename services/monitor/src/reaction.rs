use coact_messages::Command;
use coact_run_records::ReactionReport;
use hdrhistogram::Histogram;

/// How long after a decision the movement for it begins: the first command that it changes.
#[derive(Debug)]
pub struct Reaction {
    /// Cycles from a decision to its first command.
    times: Histogram<u64>,
    /// Movements that decisions had begun at the last command seen.
    begun: u32,
}

impl Reaction {
    /// Nothing seen yet.
    pub fn new() -> Self {
        Self { times: crate::histogram(), begun: 0 }
    }

    /// Adds the movement that began with this command, if one did.
    pub fn command(&mut self, command: &Command) {
        if command.begun != self.begun {
            self.begun = command.begun;
            self.times.saturating_record(command.reaction.into());
        }
    }

    /// The times so far in short.
    pub fn report(&self) -> ReactionReport {
        let at = |quantile| self.times.value_at_quantile(quantile);
        ReactionReport { count: self.times.len(), p50: at(0.5), p99: at(0.99), max: self.times.max() }
    }
}

impl Default for Reaction {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_movement_counts_once() {
        let mut reaction = Reaction::new();
        let mut command: Command = bytemuck::Zeroable::zeroed();
        reaction.command(&command);
        assert_eq!(reaction.report(), ReactionReport::default());
        for (begun, cycles) in [(1, 20), (1, 20), (2, 40)] {
            (command.begun, command.reaction) = (begun, cycles);
            reaction.command(&command);
        }
        assert_eq!(reaction.report(), ReactionReport { count: 2, p50: 20, p99: 40, max: 40 });
    }
}
