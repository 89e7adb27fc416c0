use coact_period::seconds;
use coact_run_records::Event;

/// Notices from when to when the monitor did not see what happened.
///
/// It stood still for longer than its readers' buffers reach back, or was replaced: then pulses are missing that their
/// process has published, as the sequence of the next one tells.
#[derive(Debug, Default)]
pub(crate) struct Blindness {
    /// First and last cycle that was not seen, since the last look.
    cycles: Option<(u64, u64)>,
}

impl Blindness {
    /// So many pulses before that of `cycle` were lost.
    pub(crate) fn lost(&mut self, cycle: u64, unseen: u64) {
        if unseen == 0 {
            return;
        }
        let (first, last) = (cycle.saturating_sub(unseen), cycle.saturating_sub(1));
        let known = self.cycles.unwrap_or((first, last));
        self.cycles = Some((known.0.min(first), known.1.max(last)));
    }

    /// What was found since the last call.
    pub(crate) fn take(&mut self) -> Option<Event> {
        self.cycles.take().map(|(first, last)| Event::Blind { from_ms: first, until_ms: last + 1 })
    }
}

/// For how long the monitor was blind, as the events of a run say, s.
pub(crate) fn blind_s(events: &[Event]) -> f64 {
    let spans = events.iter().filter_map(|event| match event {
        Event::Blind { from_ms, until_ms } => Some(until_ms.saturating_sub(*from_ms)),
        _ => None,
    });
    seconds(spans.sum())
}
