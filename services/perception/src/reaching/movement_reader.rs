use super::hand_path::{HandPath, PathFrame};
use super::movement_model::{CURVE_BEGINS, CURVE_KNOTS, CURVE_MODES, CURVE_SPACING, MovementModel, TENTH};
use nalgebra::{SMatrix, SVector, Vector2};

/// Scatter of the middle between two keypoints of a frame, m: somewhat more than the simulated tracker's.
const SEEN: f64 = 0.003;
/// How far from a part's middle it is grasped, m: standard deviation along and aside. Chosen by hand, some millimetres: people grasp the
/// recorded cubes near their middle, and what perception takes for the middle of a part scatters as well.
const GRASPED: f64 = 0.008;
/// By how much more a person of whom nothing is known may differ than the recorded ones, in the ways and in the pace of the hand: few people
/// do not show all. Chosen on the recorded people, each left out in turn.
const OTHERS_WAYS: f64 = 1.5;
const OTHERS_PACE: f64 = 1.4;
/// Length of a reach from which on its ways vary in proportion to it, m: on shorter ones what hand and fingers do by themselves counts. Chosen
/// by hand, half of the recorded reaches' length.
const ALIKE: f64 = 0.15;
/// Durations that are tried, and how far they go, in standard deviations.
const DURATIONS: usize = 9;
const WIDEST: f64 = 2.2;
/// Fraction of a duration by which a reach may last longer, and still have it.
const LATE: f64 = 1.08;
/// Places nearer than this to where the hand lay are no ends of reaches, m.
const SHORTEST: f64 = 0.05;
/// Mean and modes.
const CURVES: usize = CURVE_MODES + 1;
/// Modes, and those of the place that is grasped.
const UNKNOWNS: usize = CURVE_MODES + 2;

/// Reads from the hand's way so far how well it fits a reach to a place.
#[derive(Debug, Clone)]
pub(crate) struct MovementReader {
    /// At each knot: mean and modes, along and aside.
    knots: [[[f64; 2]; CURVES]; CURVE_KNOTS],
    scatter: f64,
    /// Durations from a tenth of the way to contact, s, with the logarithm of how usual each is.
    durations: [(f64, f64); DURATIONS],
}

/// What the frames so far say of the unknowns, for one place and one duration.
struct Evidence {
    precision: SMatrix<f64, UNKNOWNS, UNKNOWNS>,
    pull: SVector<f64, UNKNOWNS>,
    square: f64,
}

impl MovementReader {
    pub fn new(model: &MovementModel) -> Self {
        let at = |knot: usize, curve: usize| match curve.checked_sub(1) {
            None => model.mean[knot],
            Some(mode) => model.modes[mode][knot].map(|value| OTHERS_WAYS * value),
        };
        let deviate = |index: usize| WIDEST * (2.0 * index as f64 / (DURATIONS - 1) as f64 - 1.0);
        let spread = OTHERS_PACE * model.spread;
        let duration = |deviate: f64| (model.duration * (spread * deviate).exp(), -0.5 * deviate * deviate);
        Self {
            knots: std::array::from_fn(|knot| std::array::from_fn(|curve| at(knot, curve))),
            scatter: model.scatter,
            durations: std::array::from_fn(|index| duration(deviate(index))),
        }
    }

    /// Logarithm of the density of what was seen of the hand in the first so many frames, if it reaches for `place` (m, on the table plane), up to what is the same
    /// for all places; minus infinity where no reach leads.
    pub fn likelihood(&self, path: &HandPath, frames: usize, place: Vector2<f64>) -> f64 {
        let way = place - path.start();
        let length = way.norm();
        let frames = &path.frames()[..frames.min(path.frames().len())];
        if length < SHORTEST || frames.is_empty() {
            return f64::NEG_INFINITY;
        }
        let begun = path.time_at(TENTH * length);
        let each = self
            .durations
            .map(|(duration, usual)| usual + self.given(frames, path.thumb_side(), way, begun, duration));
        let best = each.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if best == f64::NEG_INFINITY {
            return best;
        }
        best + each.iter().map(|log| (log - best).exp()).sum::<f64>().ln()
    }

    /// The same for a reach that takes so long from `begun`, s, to contact.
    fn given(
        &self,
        frames: &[PathFrame],
        thumb_side: f64,
        way: Vector2<f64>,
        begun: f64,
        duration: f64,
    ) -> f64 {
        let newest = frames.last().map_or(0.0, |frame| f64::from(frame.time));
        if newest - begun > LATE * duration {
            return f64::NEG_INFINITY;
        }
        let square = way.norm_squared();
        let grasped = GRASPED / square.sqrt();
        let varied = (1.0 + ALIKE * ALIKE / square).sqrt();
        let mut evidence = Evidence { precision: SMatrix::zeros(), pull: SVector::zeros(), square: 0.0 };
        // Every second frame, the newest among them.
        let read = || frames.iter().rev().step_by(2);
        for frame in read() {
            let moved = Vector2::from(frame.moved.map(f64::from));
            let seen = [moved.dot(&way) / square, thumb_side * way.perp(&moved) / square];
            evidence.take_in(seen, &self.curves((f64::from(frame.time) - begun) / duration), varied, grasped);
        }
        let variance = self.scatter + SEEN * SEEN / square;
        // Two coordinates of each frame.
        let count = read().count() as f64;
        evidence.log_density(variance) - count * (variance.ln() + square.ln())
    }

    /// Mean and modes at one time, between two knots.
    fn curves(&self, time: f64) -> [[f64; 2]; CURVES] {
        let position = ((time - CURVE_BEGINS) / CURVE_SPACING).clamp(0.0, (CURVE_KNOTS - 1) as f64);
        let knot = (position as usize).min(CURVE_KNOTS - 2);
        let part = position - knot as f64;
        let [before, after] = [&self.knots[knot], &self.knots[knot + 1]];
        std::array::from_fn(|curve| {
            std::array::from_fn(|axis| {
                before[curve][axis] + part * (after[curve][axis] - before[curve][axis])
            })
        })
    }
}

impl Evidence {
    /// Takes in where the hand was in one frame, along and aside. Where a place is grasped off its middle, the whole way turns and stretches.
    fn take_in(&mut self, seen: [f64; 2], curves: &[[f64; 2]; CURVES], varied: f64, grasped: f64) {
        let mean = curves[0];
        let off = [mean, [-mean[1], mean[0]]].map(|own| own.map(|value| grasped * value));
        for axis in 0..2 {
            let miss = seen[axis] - mean[axis];
            let mut by = SVector::<f64, UNKNOWNS>::zeros();
            curves[1..].iter().zip(by.iter_mut()).for_each(|(mode, by)| *by = varied * mode[axis]);
            off.iter().zip(by.iter_mut().skip(CURVE_MODES)).for_each(|(off, by)| *by = off[axis]);
            self.precision.ger(1.0, &by, &by, 1.0);
            self.pull.axpy(miss, &by, 1.0);
            self.square += miss * miss;
        }
    }

    /// Logarithm of the density of all that was taken in, where each coordinate scatters with this variance, without that variance's own
    /// normalisation.
    fn log_density(&self, variance: f64) -> f64 {
        let precision = SMatrix::identity() + self.precision / variance;
        let Some(factor) = precision.cholesky() else { return f64::NEG_INFINITY };
        let pull = self.pull / variance;
        let explained = pull.dot(&factor.solve(&pull));
        let spread: f64 = factor.l_dirty().diagonal().iter().map(|value| value.ln()).sum();
        -0.5 * (self.square / variance - explained) - spread
    }
}
