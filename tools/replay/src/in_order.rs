use coact_run_recording::Recorded;
use std::collections::BTreeMap;

/// Puts messages into the order of their publication. The recorder takes them topic by topic, so that an output may stand before its
/// input; never by more than the recorder was held up.
#[derive(Debug, Default)]
pub(crate) struct InOrder {
    waiting: BTreeMap<(u64, u8, u64), Recorded>,
    count: u64,
}

/// How long a message waits for earlier ones, ns. The recorder's buffers do not hold more than half a second.
const HOLD_NS: u64 = 500_000_000;
/// So many wait at most: some seconds of them.
const MOST: usize = 50_000;

impl InOrder {
    pub fn put(&mut self, message: Recorded) {
        let key = (message.header().published_ns, rank(&message), self.count);
        self.count += 1;
        self.waiting.insert(key, message);
    }

    /// The next one, once nothing earlier can come; without more to come, whatever is left.
    pub fn next(&mut self, more_may_come: bool) -> Option<Recorded> {
        let (first, last) = (self.waiting.first_key_value()?.0.0, self.waiting.last_key_value()?.0.0);
        let is_due = !more_may_come || last - first > HOLD_NS || self.waiting.len() > MOST;
        is_due.then(|| self.waiting.pop_first())?.map(|(_, message)| message)
    }
}

/// A pulse tells how its output was computed, and comes before it.
fn rank(message: &Recorded) -> u8 {
    u8::from(!matches!(message, Recorded::Pulse { .. }))
}
