use super::hand_path::{HandPath, PathFrame};
use super::movement_model::{CURVE_BEGINS, CURVE_KNOTS, CURVE_MODES, CURVE_SPACING, MovementModel, TENTH};
use super::person_movement::{Expected, PersonMovement};
use nalgebra::{SMatrix, SVector, Vector2};

/// Scatter of the middle between two keypoints of a frame, m: somewhat more than the simulated tracker's.
const SEEN: f64 = 0.003;
/// How far from a part's middle it is grasped, m: standard deviation along and aside. Chosen by hand, some millimetres: people grasp the
/// recorded cubes near their middle, and what perception takes for the middle of a part scatters as well.
const GRASPED: f64 = 0.008;
/// Length of a reach from which on its ways vary in proportion to it, m: on shorter ones what hand and fingers do by themselves counts. Chosen
/// by hand, a little less than the recorded reaches' length: with half of it, parts beside the resting hand lost against others farther on.
const ALIKE: f64 = 0.25;
/// Durations that are tried, and how far they go, in standard deviations.
const DURATIONS: usize = 9;
const WIDEST: f64 = 2.2;
/// Fraction of a duration by which a reach may last longer, and still have it.
const LATE: f64 = 1.08;
/// Places nearer than this to where the hand lay are no ends of reaches, m.
const SHORTEST: f64 = 0.05;
/// Fewest frames of a reach of which something is learned.
const FEWEST: usize = 12;
/// Mean and modes.
const CURVES: usize = CURVE_MODES + 1;
/// Modes, and those of the place that is grasped.
const UNKNOWNS: usize = CURVE_MODES + 2;

/// Reads from the hand's way so far how well it fits a reach to a place.
#[derive(Debug, Clone)]
pub(crate) struct MovementReader {
    model: MovementModel,
    /// At each knot: mean and modes, along and aside.
    knots: [[[f64; 2]; CURVES]; CURVE_KNOTS],
}

/// The hand's way, against a reach to one place.
struct Reach<'a> {
    frames: &'a [PathFrame],
    /// From where the hand lay to the place, m.
    way: Vector2<f64>,
    thumb_side: f64,
    /// When a tenth of the way was covered, s.
    begun: f64,
}

/// What the frames so far say of the unknowns, for one place and one duration.
struct Evidence {
    precision: SMatrix<f64, UNKNOWNS, UNKNOWNS>,
    pull: SVector<f64, UNKNOWNS>,
    square: f64,
    frames: f64,
}

impl MovementReader {
    pub fn new(model: &MovementModel) -> Self {
        let at = |knot: usize, curve: usize| match curve.checked_sub(1) {
            None => model.mean[knot],
            Some(mode) => model.modes[mode][knot],
        };
        let knots = std::array::from_fn(|knot| std::array::from_fn(|curve| at(knot, curve)));
        Self { knots, model: model.clone() }
    }

    /// Logarithm of the density of what was seen of this person's hand in the first so many frames, if it reaches for `place` (m, on the table
    /// plane), up to what is the same for all places; minus infinity where no reach leads.
    pub fn likelihood(
        &self,
        path: &HandPath,
        frames: usize,
        person: &PersonMovement,
        place: Vector2<f64>,
    ) -> f64 {
        let Some(reach) = Reach::new(path, frames, place) else { return f64::NEG_INFINITY };
        let expected = person.expected(&self.model);
        let each = self.durations(&expected).map(|(duration, usual)| {
            usual
                + self
                    .evidence(&reach, &expected, duration)
                    .map_or(f64::NEG_INFINITY, |it| self.density(&reach, &it).0)
        });
        let best = each.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if best == f64::NEG_INFINITY {
            return best;
        }
        best + each.iter().map(|log| (log - best).exp()).sum::<f64>().ln()
    }

    /// Learns how this person reaches, once it is known where the reach has led.
    pub fn learn(&self, path: &HandPath, place: Vector2<f64>, person: &mut PersonMovement) {
        let Some(reach) = Reach::new(path, path.frames().len(), place) else { return };
        if reach.frames.len() < FEWEST {
            return;
        }
        // Against what is expected of anybody: what the reaches so far have told must not tell once more.
        let anyone: PersonMovement = bytemuck::Zeroable::zeroed();
        let expected = anyone.expected(&self.model);
        let found = self.durations(&expected).into_iter().filter_map(|(duration, usual)| {
            let (density, unknowns) = self.density(&reach, &self.evidence(&reach, &expected, duration)?);
            Some((usual + density, duration, unknowns?))
        });
        if let Some((_, duration, unknowns)) = found.max_by(|one, other| one.0.total_cmp(&other.0)) {
            let coefficients = std::array::from_fn(|mode| expected.modes[mode].1 * unknowns[mode]);
            person.remember(&coefficients, (duration / self.model.duration).ln());
        }
    }

    /// Durations from a tenth of the way to contact, s, each with the logarithm of how usual it is.
    fn durations(&self, expected: &Expected) -> [(f64, f64); DURATIONS] {
        let (mean, deviation) = expected.pace;
        std::array::from_fn(|index| {
            let deviate = WIDEST * (2.0 * index as f64 / (DURATIONS - 1) as f64 - 1.0);
            (self.model.duration * (mean + deviation * deviate).exp(), -0.5 * deviate * deviate)
        })
    }

    /// What was seen says of a reach that takes so long; `None` if it would be over.
    fn evidence(&self, reach: &Reach, expected: &Expected, duration: f64) -> Option<Evidence> {
        let newest = reach.frames.last().map_or(0.0, |frame| f64::from(frame.time));
        if newest - reach.begun > LATE * duration {
            return None;
        }
        let mut evidence = Evidence::none();
        // Every second frame, the newest among them.
        for frame in reach.frames.iter().rev().step_by(2) {
            let curves = self.curves((f64::from(frame.time) - reach.begun) / duration);
            evidence.take_in(reach, reach.seen(frame), &curves, expected);
        }
        Some(evidence)
    }

    /// Logarithm of the density of what was seen, and the likeliest unknowns, in their standard deviations.
    fn density(&self, reach: &Reach, evidence: &Evidence) -> (f64, Option<SVector<f64, UNKNOWNS>>) {
        let square = reach.way.norm_squared();
        let variance = self.model.scatter + SEEN * SEEN / square;
        let precision = SMatrix::identity() + evidence.precision / variance;
        let Some(factor) = precision.cholesky() else { return (f64::NEG_INFINITY, None) };
        let pull = evidence.pull / variance;
        let unknowns = factor.solve(&pull);
        let spread: f64 = factor.l_dirty().diagonal().iter().map(|value| value.ln()).sum();
        let fits = -0.5 * (evidence.square / variance - pull.dot(&unknowns)) - spread;
        // Two coordinates of each frame.
        (fits - evidence.frames * (variance.ln() + square.ln()), Some(unknowns))
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

impl<'a> Reach<'a> {
    /// `None` where no reach leads.
    fn new(path: &'a HandPath, frames: usize, place: Vector2<f64>) -> Option<Self> {
        let way = place - path.start();
        let frames = path.frames().get(..frames)?;
        let is_one = way.norm() >= SHORTEST && !frames.is_empty();
        let begun = path.time_at(TENTH * way.norm());
        is_one.then_some(Self { frames, way, thumb_side: path.thumb_side(), begun })
    }

    /// Where the hand was in a frame: along the way and aside, in units of its length.
    fn seen(&self, frame: &PathFrame) -> [f64; 2] {
        let moved = Vector2::from(frame.moved.map(f64::from));
        [moved.dot(&self.way), self.thumb_side * self.way.perp(&moved)]
            .map(|part| part / self.way.norm_squared())
    }
}

impl Evidence {
    fn none() -> Self {
        Self { precision: SMatrix::zeros(), pull: SVector::zeros(), square: 0.0, frames: 0.0 }
    }

    /// Takes in where the hand was in one frame. Where a part is grasped off its middle, the whole way turns and stretches.
    fn take_in(&mut self, reach: &Reach, seen: [f64; 2], curves: &[[f64; 2]; CURVES], expected: &Expected) {
        let square = reach.way.norm_squared();
        let (varied, grasped) = ((1.0 + ALIKE * ALIKE / square).sqrt(), GRASPED / square.sqrt());
        let [along, aside] = curves[0];
        let off = [[along, -aside], [aside, along]];
        self.frames += 1.0;
        for axis in 0..2 {
            let mut miss = seen[axis] - curves[0][axis];
            let mut by = SVector::<f64, UNKNOWNS>::zeros();
            for ((by, mode), (mean, deviation)) in by.iter_mut().zip(&curves[1..]).zip(&expected.modes) {
                *by = varied * deviation * mode[axis];
                miss -= mean * mode[axis];
            }
            by.iter_mut().skip(CURVE_MODES).zip(off[axis]).for_each(|(by, off)| *by = grasped * off);
            self.precision.ger(1.0, &by, &by, 1.0);
            self.pull.axpy(miss, &by, 1.0);
            self.square += miss * miss;
        }
    }
}
