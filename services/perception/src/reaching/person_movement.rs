use super::movement_model::{CURVE_MODES, MovementModel};
use crate::habit::next_value;
use bytemuck::{Pod, Zeroable};
use coact_stage_state::{Implausible, ensure, finite};

/// By how much more a person of whom nothing is known may differ than the recorded ones, in the ways and in the pace of the hand: few people
/// do not show all. Chosen on the recorded people, each left out in turn.
const OTHERS_WAYS: f64 = 1.5;
const OTHERS_PACE: f64 = 1.4;

/// What this person's reaches so far have told of how the hand moves.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct PersonMovement {
    /// How many reaches.
    reaches: u64,
    /// Sum of their coefficients, mode by mode.
    sum: [f64; CURVE_MODES],
    /// Sum of the logarithms of their durations, in units of the usual one.
    pace: f64,
}

/// What is to be expected of a reach before it is seen: independent Gaussians.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Expected {
    /// Mean and standard deviation of each mode's coefficient.
    pub modes: [(f64, f64); CURVE_MODES],
    /// The same of the logarithm of the duration, in units of the usual one.
    pub pace: (f64, f64),
}

impl PersonMovement {
    /// Remembers a reach by the coefficients of its modes, and the logarithm of its duration in units of the usual one.
    pub fn remember(&mut self, coefficients: &[f64; CURVE_MODES], pace: f64) {
        self.reaches += 1;
        self.sum.iter_mut().zip(coefficients).for_each(|(sum, own)| *sum += own);
        self.pace += pace;
    }

    /// What is to be expected of this person's next reach: the recorded people's variance is divided into that between people, of which the
    /// reaches so far tell, and that between the reaches of one.
    pub fn expected(&self, model: &MovementModel) -> Expected {
        let spread = model.spread * model.spread;
        let within = |mode: usize| 1.0 - model.own[mode];
        let modes = std::array::from_fn(|mode| {
            next_value(
                self.reaches as f64,
                self.sum[mode],
                OTHERS_WAYS * OTHERS_WAYS - within(mode),
                within(mode),
            )
        });
        let within = spread * (1.0 - model.own_pace);
        let pace =
            next_value(self.reaches as f64, self.pace, OTHERS_PACE * OTHERS_PACE * spread - within, within);
        Expected { modes, pace }
    }

    /// Refuses what is none.
    pub fn check(&self) -> Result<(), Implausible> {
        ensure(self.reaches < 1 << 32, "movement.reaches", "a number of reaches that a person can make")?;
        finite("movement.sum", &self.sum)?;
        finite("movement.pace", &[self.pace])
    }
}
