use coact_messages::{Header, Pulse};

/// Deadline accounting of one process: turns what happened in a cycle into its [`Pulse`].
#[derive(Debug)]
pub(crate) struct Accounts {
    deadline_ns: u64,
    missed: u64,
    stale: u64,
    skipped: u64,
    last_cycle: Option<u64>,
    last_input: Option<(u32, u64)>,
}

/// When the parts of one cycle took place, ns of `CLOCK_MONOTONIC`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CycleTimes {
    pub(crate) released_ns: u64,
    pub(crate) scheduled_ns: u64,
    pub(crate) started_ns: u64,
    pub(crate) received_ns: u64,
}

impl Accounts {
    /// Outputs are due `deadline_ns` after each cycle's release.
    pub(crate) fn new(deadline_ns: u64) -> Self {
        Self { deadline_ns, missed: 0, stale: 0, skipped: 0, last_cycle: None, last_input: None }
    }

    /// Whether `ns` is beyond the deadline of the cycle that was released at `released_ns`.
    pub(crate) fn is_late(&self, released_ns: u64, ns: u64) -> bool {
        ns > released_ns + self.deadline_ns
    }

    /// Books one cycle that ran on `input` and published `output`.
    pub(crate) fn book(&mut self, times: CycleTimes, input: Option<&Header>, output: Header) -> Pulse {
        let identity = input.map(|header| (header.generation, header.sequence));
        let is_stale = identity.is_some() && identity == self.last_input;
        self.stale += u64::from(is_stale);
        self.missed += u64::from(self.is_late(times.released_ns, output.published_ns));
        self.skipped += self.last_cycle.map_or(0, |last| output.cycle.saturating_sub(last + 1));
        self.last_cycle = Some(output.cycle);
        self.last_input = identity;
        Pulse {
            header: output,
            released_ns: times.released_ns,
            scheduled_ns: times.scheduled_ns,
            started_ns: times.started_ns,
            input_published_ns: input.map_or(0, |header| header.published_ns),
            input_received_ns: if identity.is_none() || is_stale { 0 } else { times.received_ns },
            missed: self.missed,
            stale: self.stale,
            skipped: self.skipped,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn book(accounts: &mut Accounts, cycle: u64, input: Option<u64>, published_after: u64) -> Pulse {
        let released_ns = 1_000 * cycle;
        let times = CycleTimes {
            released_ns,
            scheduled_ns: released_ns + 1,
            started_ns: released_ns + 2,
            received_ns: released_ns + 3,
        };
        let input = input.map(|sequence| Header { sequence, published_ns: 77, ..Header::default() });
        let output = Header { cycle, published_ns: released_ns + published_after, ..Header::default() };
        accounts.book(times, input.as_ref(), output)
    }

    #[test]
    fn output_after_its_deadline_is_a_miss_and_one_exactly_at_it_is_none() {
        let mut accounts = Accounts::new(1_000);
        let missed = [500, 1_000, 1_001, 900].map(|after| book(&mut accounts, 0, Some(0), after).missed);
        assert_eq!(missed, [0, 0, 1, 1]);
    }

    #[test]
    fn input_used_twice_is_stale_and_was_not_received_again() {
        let mut accounts = Accounts::new(1_000);
        let fresh = book(&mut accounts, 1, Some(1), 1);
        let stale = book(&mut accounts, 2, Some(1), 1);
        let fresh_again = book(&mut accounts, 3, Some(2), 1);
        assert_eq!((fresh.stale, stale.stale, fresh_again.stale), (0, 1, 1));
        assert_eq!((fresh.input_received_ns, stale.input_received_ns), (1_003, 0));
        assert_eq!((fresh.input_published_ns, stale.input_published_ns), (77, 77));
    }

    #[test]
    fn no_input_at_all_is_not_stale() {
        let mut accounts = Accounts::new(1_000);
        book(&mut accounts, 1, None, 1);
        let pulse = book(&mut accounts, 2, None, 1);
        assert_eq!((pulse.stale, pulse.input_published_ns, pulse.input_received_ns), (0, 0, 0));
    }

    #[test]
    fn periods_without_a_cycle_are_skipped_but_those_before_the_first_cycle_are_not() {
        let mut accounts = Accounts::new(1_000);
        let skipped = [40, 41, 44].map(|cycle| book(&mut accounts, cycle, None, 1).skipped);
        assert_eq!(skipped, [0, 0, 2]);
    }
}
