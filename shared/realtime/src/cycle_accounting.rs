use coact_messages::{Header, Pulse};
use coact_period::PERIOD_NS;

/// Counts what went wrong in the cycles of one process, and makes each cycle's [`Pulse`].
///
/// A deadline miss is counted in [`CycleAccounting::record`]; so are cycles on stale input and skipped cycles. The pulse
/// carries the counters to the monitor, which writes them into `summary.json`, and to the supervisor, which shows them.
#[derive(Debug, Default)]
pub(crate) struct CycleAccounting {
    deadline_misses: u64,
    stale_inputs: u64,
    skipped_cycles: u64,
    last_cycle: Option<u64>,
    /// Generation and sequence of the input of the cycle before.
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

/// Whether `ns` is beyond the deadline of the cycle that was released at `released_ns`: one period after the release.
pub(crate) fn misses_deadline(released_ns: u64, ns: u64) -> bool {
    ns > released_ns + PERIOD_NS
}

impl CycleAccounting {
    /// Counts one cycle that ran on `input` and published `output`.
    pub(crate) fn record(&mut self, times: CycleTimes, input: Option<&Header>, output: Header) -> Pulse {
        let identity = input.map(|header| (header.generation, header.sequence));
        let is_stale = identity.is_some() && identity == self.last_input;
        self.stale_inputs += u64::from(is_stale);
        self.deadline_misses += u64::from(misses_deadline(times.released_ns, output.published_ns));
        self.skipped_cycles += self.last_cycle.map_or(0, |last| output.cycle.saturating_sub(last + 1));
        self.last_cycle = Some(output.cycle);
        self.last_input = identity;
        Pulse {
            header: output,
            released_ns: times.released_ns,
            scheduled_ns: times.scheduled_ns,
            started_ns: times.started_ns,
            input_published_ns: input.map_or(0, |header| header.published_ns),
            input_received_ns: if identity.is_none() || is_stale { 0 } else { times.received_ns },
            missed: self.deadline_misses,
            stale: self.stale_inputs,
            skipped: self.skipped_cycles,
            ..Pulse::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Records a cycle that published so many ns after its release.
    fn record(
        accounting: &mut CycleAccounting,
        cycle: u64,
        input: Option<u64>,
        published_after: u64,
    ) -> Pulse {
        let released_ns = PERIOD_NS * cycle;
        let times = CycleTimes {
            released_ns,
            scheduled_ns: released_ns + 1,
            started_ns: released_ns + 2,
            received_ns: released_ns + 3,
        };
        let input = input.map(|sequence| Header { sequence, published_ns: 77, ..Header::default() });
        let output = Header { cycle, published_ns: released_ns + published_after, ..Header::default() };
        accounting.record(times, input.as_ref(), output)
    }

    #[test]
    fn output_after_its_deadline_is_a_miss_and_one_exactly_at_it_is_none() {
        let mut accounting = CycleAccounting::default();
        let published_after = [PERIOD_NS / 2, PERIOD_NS, PERIOD_NS + 1, PERIOD_NS - 1];
        let missed = published_after.map(|after| record(&mut accounting, 0, Some(0), after).missed);
        assert_eq!(missed, [0, 0, 1, 1]);
    }

    #[test]
    fn input_used_twice_is_stale_and_was_not_received_again() {
        let mut accounting = CycleAccounting::default();
        let fresh = record(&mut accounting, 1, Some(1), 1);
        let stale = record(&mut accounting, 2, Some(1), 1);
        let fresh_again = record(&mut accounting, 3, Some(2), 1);
        assert_eq!((fresh.stale, stale.stale, fresh_again.stale), (0, 1, 1));
        assert_eq!((fresh.input_received_ns, stale.input_received_ns), (PERIOD_NS + 3, 0));
        assert_eq!((fresh.input_published_ns, stale.input_published_ns), (77, 77));
    }

    #[test]
    fn no_input_at_all_is_not_stale() {
        let mut accounting = CycleAccounting::default();
        record(&mut accounting, 1, None, 1);
        let pulse = record(&mut accounting, 2, None, 1);
        assert_eq!((pulse.stale, pulse.input_published_ns, pulse.input_received_ns), (0, 0, 0));
    }

    #[test]
    fn periods_without_a_cycle_are_skipped_but_those_before_the_first_cycle_are_not() {
        let mut accounting = CycleAccounting::default();
        let skipped = [40, 41, 44].map(|cycle| record(&mut accounting, cycle, None, 1).skipped);
        assert_eq!(skipped, [0, 0, 2]);
    }
}
