use coact_period::PERIOD_NS;
use coact_run_records::{FaultReport, OutageReport};
use serde::Serialize;

/// What the readers of a stage with a standby went without while the stage itself was dead, and otherwise.
///
/// Where the standby misses a cycle, the fault may have kept it, or the machine, by less than any probe sees. So the same is counted
/// where nothing was struck: a fault that costs nothing leaves the two shares alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct ReadersOutage {
    /// Cycles between a fault and its recovery.
    pub during_faults: MissedCycles,
    /// All other cycles of the run.
    pub otherwise: MissedCycles,
}

/// Cycles without a timely message, of those due.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct MissedCycles {
    /// Without.
    pub missed: u64,
    /// Due.
    pub due: u64,
}

impl ReadersOutage {
    /// Of a standby with this outage over the whole run.
    pub(crate) fn before_any(whole: &OutageReport) -> Self {
        let otherwise = MissedCycles { missed: whole.without_output, due: whole.due };
        Self { during_faults: MissedCycles::default(), otherwise }
    }

    /// Adds a fault during which the standby `missed` so many cycles. One that never recovered has no end, and is not added.
    pub(crate) fn add(&mut self, fault: &FaultReport, missed: u64) {
        let Some(recovered_ms) = fault.recovered_ms else { return };
        let due = (recovered_ms * 1e6 / PERIOD_NS as f64).round() as u64;
        let Self { during_faults, otherwise } = self;
        during_faults.missed += missed;
        during_faults.due += due;
        otherwise.missed = otherwise.missed.saturating_sub(missed);
        otherwise.due = otherwise.due.saturating_sub(due);
    }
}

impl MissedCycles {
    /// How many of a thousand that were due; 0 where none was.
    pub fn per_thousand(&self) -> f64 {
        if self.due == 0 { 0.0 } else { 1000.0 * self.missed as f64 / self.due as f64 }
    }
}
