use serde::{Deserialize, Serialize};

/// Fraction of the way from which a reach's time counts: before it, the tracker's scatter hides when the hand set out.
pub const TENTH: f64 = 0.1;
/// Time at which the curves begin, as a fraction of the time from a tenth of the way to contact.
pub const CURVE_BEGINS: f64 = -0.3;
/// Time between their knots; between them they are straight.
pub const CURVE_SPACING: f64 = 0.05;
/// Knots: the last one is contact.
pub const CURVE_KNOTS: usize = 27;
/// Modes: what is left scatters by some thousandths of the way. With six only, much less of a person who is unlike the others is understood.
pub const CURVE_MODES: usize = 10;

/// How people's hands move when they reach, from recordings: part of the model file that `coact train` makes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MovementModel {
    /// Median time from a tenth of the way to contact, s.
    pub duration: f64,
    /// Standard deviation of its logarithm.
    pub spread: f64,
    /// Variance of what no mode explains, of each coordinate at each instant, in units of the way's square.
    pub scatter: f64,
    /// Mean way at each knot: along the straight line, and aside from it to the side of the thumb, in units of its length.
    pub mean: Vec<[f64; 2]>,
    /// In what ways reaches differ from it, each at one standard deviation.
    pub modes: Vec<Vec<[f64; 2]>>,
    /// Share of each mode's variance that lies between people, not between the reaches of one: what a person's earlier reaches tell.
    pub own: Vec<f64>,
    /// The same of the logarithm of duration.
    pub own_pace: f64,
}

impl MovementModel {
    /// Refuses what is no model; the text says what was found and expected.
    pub(crate) fn check(&self) -> Result<(), String> {
        if !(self.duration > 0.1 && self.duration < 3.0) {
            return Err(format!("duration: expected seconds between 0.1 and 3, found {}", self.duration));
        }
        for (name, value) in [("spread", self.spread), ("scatter", self.scatter)] {
            if !(value > 0.0 && value < 1.0) {
                return Err(format!("{name}: expected a number between 0 and 1, found {value}"));
            }
        }
        for (name, found) in [("modes", self.modes.len()), ("own", self.own.len())] {
            if found != CURVE_MODES {
                return Err(format!("{name}: expected {CURVE_MODES}, found {found}"));
            }
        }
        if !self.own.iter().chain([&self.own_pace]).all(|share| (0.0..1.0).contains(share)) {
            return Err("own and own_pace: expected shares between 0 and 1".into());
        }
        for (name, curve) in
            [("mean", &self.mean)].into_iter().chain(self.modes.iter().map(|mode| ("modes", mode)))
        {
            if curve.len() != CURVE_KNOTS || !curve.as_flattened().iter().all(|value| value.is_finite()) {
                return Err(format!("{name}: expected {CURVE_KNOTS} finite places, found {}", curve.len()));
            }
        }
        Ok(())
    }
}
