use bytemuck::{Pod, Zeroable};
use coact_stage_state::{Implausible, ensure};

/// Steps of displacement whose times are kept: reaches of up to 0.6 m, an arm's length.
const STEPS: usize = 40;
/// One step, m: about a frame's way at a usual reaching speed.
const STEP: f64 = 0.015;

/// When the wrist had covered how much of its way.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Progress {
    /// Steps covered so far.
    covered: u64,
    /// Time since onset at which each was covered, s.
    time: [f32; STEPS],
}

impl Progress {
    /// Refuses what is no progress.
    pub(crate) fn check(&self) -> Result<(), Implausible> {
        ensure(self.covered as usize <= STEPS, "preshape.reach.progress", "no more steps than are kept")?;
        ensure(self.time.iter().all(|time| time.is_finite()), "preshape.reach.progress", "finite times")
    }

    /// Takes in the displacement (m) at one time since onset (s).
    pub(crate) fn advance(&mut self, displacement: f64, time: f64) {
        while (self.covered as usize) < STEPS && displacement >= STEP * (self.covered + 1) as f64 {
            self.time[self.covered as usize] = time as f32;
            self.covered += 1;
        }
    }

    /// Time since onset at which `displacement` had been covered, s; `None` if it was not, or lies beyond what is kept.
    pub(crate) fn time_to(&self, displacement: f64) -> Option<f64> {
        let steps = displacement / STEP - 1.0;
        let whole = steps.floor().max(0.0) as usize;
        let next = whole + 1;
        if next >= (self.covered as usize).min(STEPS) {
            return None;
        }
        let [before, after] = [self.time[whole], self.time[next]].map(f64::from);
        Some(before + (after - before) * (steps - whole as f64).clamp(0.0, 1.0))
    }
}
