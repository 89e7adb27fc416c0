//! Smoothing: the change of a movement for which hand and joints move with the least jerk. People move the hand on nearly
//! straight paths with a minimum-jerk profile of speed (Flash, Hogan, J. Neurosci. 5, 1985), and the joints on whatever
//! paths that takes.
//!
//! The method is Gauss and Newton's for least squares, with a step that is shortened until it helps. Joint limits,
//! clearances and line constraints are penalties.

mod change;
mod evaluation;
mod shapes;

use crate::line_constraint::LineConstraint;
use crate::posture_cost::WEIGHT;
use crate::{Clearance, Mechanism, Segment};
pub(crate) use change::Change;
use coact_robot::Posture;
use evaluation::Evaluation;
use nalgebra::{DMatrix, DVector};

/// Pieces of equal time between whose ends jerk is measured. Chosen by hand: a trade-off with the time of planning.
const PIECES: usize = 36;
/// Steps of Gauss and Newton at most. Chosen by hand.
const STEPS: u32 = 8;
/// The fractions of a step that are tried, one after the other, until the movement becomes smoother.
const STEP_FRACTIONS: [f64; 4] = [1.0, 0.5, 0.25, 0.1];
/// Weight of the joints' squared jerk against the hand's squared normalised jerk, 1/rad². Chosen by hand: small, so
/// that the joints settle only what the hand leaves open.
const JOINTS: f64 = 0.03;
/// Penalties, chosen by hand against the merit of a straight minimum-jerk movement, which is 360: at one place a joint
/// 1 mrad beyond its limit (1/rad²) and a link 1 mm too near (1/m²) cost 10 each, the hand 1 mm off its line (1/m²) 30.
const BEYOND_LIMIT: f64 = 1e7;
const TOO_NEAR: f64 = 1e7;
const OFF_LINE: f64 = 3e7;
/// Penalty of passing the postures after leaving and before the approach elsewhere, 1/rad²: 4 for 10 mrad. Chosen by
/// hand: these may give way for a line constraint, but not wander.
const MOVED: f64 = 4e4;
/// Distance from the position limits that is kept, rad. Chosen by hand: a penalty gives way a little, and the limit itself
/// must hold.
const FROM_LIMITS: f64 = 0.01;
/// Added to the diagonal of the normal equations, so that they can be solved where a change has no effect.
const DAMPING: f64 = 1e-9;

/// The squares of third differences of a movement of 1 s, times this, add up to half the integral of its squared jerk:
/// sqrt(PIECES⁵ / 2), rounded to one decimal.
const JERK_SCALE: f64 = 5498.5;
const _: () = {
    let squared = (PIECES * PIECES * PIECES * PIECES * PIECES) as f64 / 2.0;
    assert!((JERK_SCALE * JERK_SCALE / squared - 1.0).abs() < 1e-4, "JERK_SCALE belongs to other PIECES");
};

/// The clearance of a place of a movement, and how much of it is required there, m.
pub(crate) type Required<'a> = (Clearance<'a>, f64);

/// The change of these segments for which the jerk of hand and joints is least.
///
/// `is_free`: whether the states at the waypoints may be changed, too. `required`: the clearance that is required at an
/// instant of the segments. `lines`: lines to which the hand keeps.
pub(crate) fn smoothest<'a>(
    mechanism: &'a Mechanism,
    segments: &[Segment],
    is_free: bool,
    required: &dyn Fn(f64) -> Required<'a>,
    lines: &[LineConstraint],
) -> Change {
    let smoothing = Smoothing::of(mechanism, segments, is_free, required, lines);
    let mut best = DVector::zeros(7 * smoothing.shapes.len());
    let mut evaluation = smoothing.evaluate(&best);
    for _ in 0..STEPS {
        let Some(step) = smoothing.step(&evaluation, &best) else { break };
        let smoother = STEP_FRACTIONS.iter().find_map(|fraction| {
            let next = &best + *fraction * &step;
            let found = smoothing.evaluate(&next);
            (found.merit < evaluation.merit).then_some((next, found))
        });
        match smoother {
            Some(found) => (best, evaluation) = found,
            None => break,
        }
    }
    Change::of(&best)
}

/// A movement of all joints, scaled to 1 s, and how it can be changed.
struct Smoothing<'a> {
    mechanism: &'a Mechanism,
    /// Postures at equal steps of time.
    postures: Vec<Posture>,
    /// The clearance that is required there.
    required: Vec<Required<'a>>,
    /// Indices of the segments there.
    segments: Vec<usize>,
    lines: Vec<LineConstraint>,
    /// Shapes of the changes at these steps, the same for all joints: see [`Change`].
    shapes: Vec<Vec<f64>>,
    /// Third differences of the shapes, as jerks.
    jerks: Vec<Vec<f64>>,
    /// Indices of the shapes that move the postures after leaving and before the approach.
    moved: Vec<usize>,
}

impl<'a> Smoothing<'a> {
    fn of(
        mechanism: &'a Mechanism,
        segments: &[Segment],
        is_free: bool,
        required: &dyn Fn(f64) -> Required<'a>,
        lines: &[LineConstraint],
    ) -> Self {
        let total: f64 = segments.iter().map(|segment| segment.motion.duration).sum();
        let is_moved =
            |waypoint: usize| lines.iter().any(|line| (waypoint..waypoint + 2).contains(&line.segment));
        let mut shapes = vec![Vec::new(); shapes::count(segments, is_free)];
        let (mut postures, mut segment_of) = (Vec::new(), Vec::new());
        for piece in 0..=PIECES {
            let (mut t, mut index) = (piece as f64 / PIECES as f64 * total, 0);
            while index + 1 < segments.len() && t >= segments[index].motion.duration {
                t -= segments[index].motion.duration;
                index += 1;
            }
            postures.push(segments[index].motion.at(t).map(|state| state.position));
            segment_of.push(index);
            let values = shapes::values(segments, shapes.len(), (index, t, total), &is_moved);
            shapes.iter_mut().zip(values).for_each(|(shape, value)| shape.push(value));
        }
        let required = (0..=PIECES).map(|piece| required(piece as f64 / PIECES as f64 * total)).collect();
        let jerk = |shape: &Vec<f64>| shape.windows(4).map(|p| third_difference(p) * JERK_SCALE).collect();
        let jerks = shapes.iter().map(jerk).collect();
        let moved = (0..shapes.len() / 3).filter(|waypoint| is_moved(*waypoint));
        let moved = moved.map(|waypoint| 1 + 3 * waypoint).collect();
        Self {
            mechanism,
            postures,
            required,
            segments: segment_of,
            lines: lines.to_vec(),
            shapes,
            jerks,
            moved,
        }
    }

    /// The step that makes the merit least, were the hand's path linear in the change.
    fn step(&self, evaluation: &Evaluation, change: &DVector<f64>) -> Option<DVector<f64>> {
        let count = self.shapes.len();
        let mut matrix = DMatrix::<f64>::identity(7 * count, 7 * count) * DAMPING;
        let mut right = DVector::zeros(7 * count);
        for (jerk, gradient) in evaluation.jerk.iter().zip(&evaluation.gradient) {
            matrix.gemm_tr(1.0, gradient, gradient, 1.0);
            right.gemv_tr(-1.0, gradient, jerk, 1.0);
        }
        for violation in &evaluation.violations {
            let row = DVector::from_fn(7 * count, |column, _| {
                self.shapes[column / 7][violation.piece] * violation.gradient[column % 7]
            });
            matrix.ger(1.0, &row, &row, 1.0);
            right.axpy(-violation.amount, &row, 1.0);
        }
        for variable in self.moved.iter().flat_map(|shape| 7 * shape..7 * shape + 7) {
            matrix[(variable, variable)] += MOVED;
            right[variable] -= MOVED * change[variable];
        }
        self.add_joints(&mut matrix, &mut right, change);
        matrix.cholesky().map(|factors| factors.solve(&right))
    }

    /// Adds the joints' jerk to the normal equations.
    fn add_joints(&self, matrix: &mut DMatrix<f64>, right: &mut DVector<f64>, change: &DVector<f64>) {
        let count = self.shapes.len();
        for one in 0..count {
            for joint in 0..7 {
                let angles: Vec<f64> = self.postures.iter().map(|posture| posture[joint]).collect();
                let pairs = angles.windows(4).zip(&self.jerks[one]);
                let given: f64 = pairs.map(|(p, jerk)| third_difference(p) * JERK_SCALE * jerk).sum();
                right[7 * one + joint] -= JOINTS * WEIGHT[joint] * given;
            }
            for other in 0..count {
                let product: f64 = self.jerks[one].iter().zip(&self.jerks[other]).map(|(a, b)| a * b).sum();
                for joint in 0..7 {
                    matrix[(7 * one + joint, 7 * other + joint)] += JOINTS * WEIGHT[joint] * product;
                    right[7 * one + joint] -= JOINTS * WEIGHT[joint] * product * change[7 * other + joint];
                }
            }
        }
    }
}

/// Third difference of four values.
fn third_difference(p: &[f64]) -> f64 {
    p[3] - p[0] + 3.0 * (p[1] - p[2])
}
