use crate::plausible::{ensure, optional};
use crate::{Flaw, Header, Plausible, Refusal, topic};
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// One cycle's accounts of one process: its heartbeat, and all that the latency monitor measures from.
///
/// Sent after the cycle's own output, so that it holds the output's true publication stamp
/// (`header.published_ns`). Times are ns of `CLOCK_MONOTONIC`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, Pod, Zeroable, ZeroCopySend)]
#[type_name("coact::Pulse")]
pub struct Pulse {
    /// Header of the output that this cycle published.
    pub header: Header,
    /// Start of the cycle's period: the deadline is one period later.
    pub released_ns: u64,
    /// When the cycle was due to start: its release (first stage), its input's arrival event or its latest start.
    pub scheduled_ns: u64,
    /// When it did start.
    pub started_ns: u64,
    /// Publication stamp of the input that it ran on; 0 without input.
    pub input_published_ns: u64,
    /// When that input was received; 0 without input or when the input was stale.
    pub input_received_ns: u64,
    /// Deadline misses of this process so far (this generation).
    pub missed: u64,
    /// Cycles so far that ran on an input they had used before (this generation).
    pub stale: u64,
    /// Cycles skipped so far because the one before overran (this generation).
    pub skipped: u64,
    /// Messages that it ignored so far (this generation), by the number of their [`Refusal`].
    pub refused: [u32; Refusal::COUNT],
    /// The topic of the last of them: index into [`topic::ALL`], or [`NONE`](crate::NONE).
    pub refused_topic: u32,
    /// Reserved, zero.
    pub reserved: u32,
}

/// More than any run has cycles: one for each millisecond of thousands of years. Sums of such counts do not overflow.
const MOST: u64 = 1 << 48;

impl Plausible for Pulse {
    fn check(&self) -> Result<(), Flaw> {
        let times = [
            self.released_ns,
            self.scheduled_ns,
            self.started_ns,
            self.input_published_ns,
            self.input_received_ns,
        ];
        let last = self.header.published_ns;
        ensure(times.iter().all(|time| *time <= last), "times", "times before the publication")?;
        let counts = [self.header.sequence, self.missed, self.stale, self.skipped];
        ensure(counts.iter().all(|count| *count <= MOST), "counts", "counts that a run can reach")?;
        optional("refused_topic", self.refused_topic, topic::ALL.len())
    }
}
