use coact_period::CYCLES_PER_SECOND;

/// Whether a camera of `rate` Hz captures a frame after tick `last` and up to `tick`.
pub(super) fn is_frame_due(rate: u64, last: Option<u64>, tick: u64) -> bool {
    last.is_none_or(|last| tick * rate / CYCLES_PER_SECOND != last * rate / CYCLES_PER_SECOND)
}
