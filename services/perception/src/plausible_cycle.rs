use coact_stage_state::{Implausible, ensure};

/// Refuses a cycle, or a count of cycles, that no run reaches: sums of it with a duration must not overflow.
pub(crate) fn cycle(field: &'static str, cycle: u64) -> Result<(), Implausible> {
    ensure(cycle < 1 << 60, field, "a cycle of a run")
}
