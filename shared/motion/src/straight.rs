//! Movements in which the hand moves most smoothly: people move the hand on nearly straight ways, and the joints on
//! whatever ways that takes.

use crate::comfort::WEIGHT;
use crate::frames::Frames;
use crate::guide::Guide;
use crate::segment_motion::excursion;
use crate::{Clearance, Mechanism, Segment, SegmentKind};
use coact_robot::{MotionState, Posture, Quintic};
use nalgebra::{DMatrix, DVector, Matrix3xX, Point3, SMatrix, Vector3};

/// Places of the hand between which its jerk is measured.
const PIECES: usize = 36;
/// Steps of Gauss and Newton, and the shares of one that are tried until it makes the movement smoother.
const STEPS: u32 = 8;
const SHARES: [f64; 4] = [1.0, 0.5, 0.25, 0.1];
/// What the joints' jerk counts for against that of the hand, 1/rad².
const JOINTS: f64 = 0.03;

/// What a joint beyond its limits of position costs at each place, 1/rad², the distance from them that is kept, rad, and
/// what coming too near to something costs, 1/m², and what being off the line to the goal costs, 1/m².
const BEYOND: f64 = 1e7;
const FROM_LIMITS: f64 = 0.01;
const TOO_NEAR: f64 = 1e7;
const OFF_LINE: f64 = 3e7;
/// What it costs to pass the postures after leaving and before the goal elsewhere, 1/rad².
const MOVED: f64 = 4e4;

/// What may be changed: for each joint the bounce of the reach and, where they are free, velocity and acceleration at
/// each posture passed, as for a movement of 1 s; and the posture itself where it lies between two reaches.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Change {
    pub bounce: Posture,
    pub passed: Vec<[Posture; 3]>,
}

/// The change of these segments for which the jerk of hand and joints is least.
/// `room`: the distances that count at an instant of the segments, and how much of them is kept, m. `guides`: lines to
/// which the hand keeps.
pub(crate) fn smoothest<'a>(
    mechanism: &'a Mechanism,
    segments: &[Segment],
    is_free: bool,
    room: &dyn Fn(f64) -> (Clearance<'a>, f64),
    guides: &[Guide],
) -> Change {
    let smoothing = Smoothing::of(mechanism, segments, is_free, room, guides);
    let mut best = DVector::zeros(7 * smoothing.shapes.len());
    let mut way = smoothing.way(&best);
    for _ in 0..STEPS {
        let Some(step) = smoothing.step(&way, &best) else { break };
        let smoother = SHARES.iter().find_map(|share| {
            let next = &best + *share * &step;
            let found = smoothing.way(&next);
            (found.merit < way.merit).then_some((next, found))
        });
        match smoother {
            Some(found) => (best, way) = found,
            None => break,
        }
    }
    let of = |shape: usize| std::array::from_fn(|joint| best[7 * shape + joint]);
    let passed = (0..smoothing.shapes.len() / 3).map(|via| [0, 1, 2].map(|order| of(1 + 3 * via + order)));
    Change { bounce: of(0), passed: passed.collect() }
}

/// The movement of all joints in 1 s, and how it can be changed.
struct Smoothing<'a> {
    mechanism: &'a Mechanism,
    /// Postures at equal steps of time.
    postures: Vec<Posture>,
    /// Distances that count there, and how much of them is kept, m.
    room: Vec<(Clearance<'a>, f64)>,
    /// The segments of these steps, and lines to which the hand keeps.
    segments: Vec<usize>,
    guides: Vec<Guide>,
    /// The shapes that move the posture after leaving, and that before the goal.
    moved: Vec<usize>,
    /// Shapes of the changes at these steps, the same for all joints.
    shapes: Vec<Vec<f64>>,
    /// Third differences of the shapes, as jerks.
    jerks: Vec<Vec<f64>>,
}

/// How the hand moves.
struct Way {
    merit: f64,
    /// Jerks of the hand over the length of its way, and their changes.
    jerk: Vec<Vector3<f64>>,
    gradient: Vec<Matrix3xX<f64>>,
    /// What is not kept, and its change by the joints, each with its step.
    broken: Vec<(usize, f64, Posture)>,
}

impl<'a> Smoothing<'a> {
    fn of(
        mechanism: &'a Mechanism,
        segments: &[Segment],
        is_free: bool,
        room: &dyn Fn(f64) -> (Clearance<'a>, f64),
        guides: &[Guide],
    ) -> Self {
        let total: f64 = segments.iter().map(|segment| segment.motion.duration).sum();
        let mut shapes = vec![Vec::new(); 1 + if is_free { 3 * (segments.len() - 1) } else { 0 }];
        let is_free = |via: usize| (via..via + 2).all(|segment| segments[segment].kind == SegmentKind::Reach);
        let is_moved = |via: usize| guides.iter().any(|guide| (via..via + 2).contains(&guide.segment));
        let (mut postures, mut segment_of) = (Vec::new(), Vec::new());
        for piece in 0..=PIECES {
            let (mut t, mut index) = (piece as f64 / PIECES as f64 * total, 0);
            while index + 1 < segments.len() && t >= segments[index].motion.duration {
                t -= segments[index].motion.duration;
                index += 1;
            }
            let Segment { kind, motion } = &segments[index];
            postures.push(motion.at(t).map(|state| state.position));
            segment_of.push(index);
            let own = motion.duration / total;
            let [share, ..] = excursion((t / motion.duration).min(1.0));
            shapes[0].push(if *kind == SegmentKind::Reach { share } else { 0.0 });
            for (shape, values) in shapes.iter_mut().enumerate().skip(1) {
                let (via, order) = ((shape - 1) / 3, (shape - 1) % 3);
                let of = |which: usize| if order == which { 1.0 } else { 0.0 };
                let position = if is_free(via) || is_moved(via) { of(0) } else { 0.0 };
                let moved = MotionState { position, velocity: of(1), acceleration: of(2) };
                let rest = MotionState::default();
                values.push(match index {
                    before if before == via => Quintic::new(rest, moved, own).at(t / total).position,
                    after if after == via + 1 => Quintic::new(moved, rest, own).at(t / total).position,
                    _ => 0.0,
                });
            }
        }
        let room = (0..=PIECES).map(|piece| room(piece as f64 / PIECES as f64 * total)).collect();
        let jerks = shapes.iter().map(|shape| shape.windows(4).map(|p| third(p) * UNIT).collect()).collect();
        let moved = (0..shapes.len() / 3).filter(|via| is_moved(*via)).map(|via| 1 + 3 * via).collect();
        Self {
            mechanism,
            postures,
            room,
            segments: segment_of,
            guides: guides.to_vec(),
            moved,
            shapes,
            jerks,
        }
    }

    fn way(&self, change: &DVector<f64>) -> Way {
        let joints = self.mechanism.joints();
        let count = self.shapes.len();
        let postures: Vec<Posture> = (0..=PIECES)
            .map(|piece| {
                std::array::from_fn(|joint| {
                    let changes =
                        (0..count).map(|shape| self.shapes[shape][piece] * change[7 * shape + joint]);
                    self.postures[piece][joint] + changes.sum::<f64>()
                })
            })
            .collect();
        let mut places = Vec::with_capacity(PIECES + 1);
        let mut gradients = Vec::with_capacity(PIECES + 1);
        let mut broken = self.broken(&postures);
        for (piece, posture) in postures.iter().enumerate() {
            let frames = Frames::of(self.mechanism, posture);
            let hand = frames.pose[joints - 1] * self.mechanism.arm.tool * self.mechanism.grasp_point();
            let jacobian = frames.jacobian(&hand, joints);
            let mut gradient = Matrix3xX::zeros(7 * count);
            for (shape, values) in self.shapes.iter().enumerate() {
                gradient.fixed_columns_mut::<7>(7 * shape).copy_from(&(values[piece] * jacobian));
            }
            for guide in self.guides.iter().filter(|guide| guide.segment == self.segments[piece]) {
                broken
                    .extend(off_line(guide, &hand, &jacobian).map(|(off, gradient)| (piece, off, gradient)));
            }
            places.push(hand.coords);
            gradients.push(gradient);
        }
        let length: f64 = places.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        let unit = UNIT / length.max(1e-3);
        let jerk: Vec<_> = places.windows(4).map(|p| (p[3] - p[0] + 3.0 * (p[1] - p[2])) * unit).collect();
        let gradient = gradients.windows(4).map(|p| (&p[3] - &p[0] + 3.0 * (&p[1] - &p[2])) * unit).collect();
        let of_joints: f64 = (0..7)
            .map(|joint| {
                let angles: Vec<f64> = postures.iter().map(|posture| posture[joint]).collect();
                WEIGHT[joint] * angles.windows(4).map(|p| (third(p) * UNIT).powi(2)).sum::<f64>()
            })
            .sum();
        let moved = self.moved.iter().map(|shape| change.rows(7 * shape, 7).norm_squared());
        let merit = MOVED * moved.sum::<f64>()
            + jerk.iter().map(Vector3::norm_squared).sum::<f64>()
            + JOINTS * of_joints
            + broken.iter().map(|(_, amount, _)| amount * amount).sum::<f64>();
        Way { merit, jerk, gradient, broken }
    }

    /// Limits and distances that are not kept.
    fn broken(&self, postures: &[Posture]) -> Vec<(usize, f64, Posture)> {
        let mut broken = Vec::new();
        let mut near = Vec::new();
        for (piece, posture) in postures.iter().enumerate() {
            for (joint, limit) in self.mechanism.arm.joints.iter().map(|joint| joint.limits).enumerate() {
                let (below, above) =
                    (limit.lower + FROM_LIMITS - posture[joint], posture[joint] - limit.upper + FROM_LIMITS);
                for (excess, sign) in
                    [(below, -1.0), (above, 1.0)].into_iter().filter(|(excess, _)| *excess > 0.0)
                {
                    let mut gradient = [0.0; 7];
                    gradient[joint] = sign * BEYOND.sqrt();
                    broken.push((piece, excess * BEYOND.sqrt(), gradient));
                }
            }
            let (clearance, margin) = &self.room[piece];
            clearance.near(posture, *margin, &mut near);
            broken.extend(near.iter().map(|near| {
                let short = (margin - near.distance) * TOO_NEAR.sqrt();
                (piece, short, near.gradient.map(|gradient| -gradient * TOO_NEAR.sqrt()))
            }));
        }
        broken
    }

    /// The change that makes the merit least, were the hand's way linear in it.
    fn step(&self, way: &Way, change: &DVector<f64>) -> Option<DVector<f64>> {
        let count = self.shapes.len();
        let (mut matrix, mut right) =
            (DMatrix::<f64>::identity(7 * count, 7 * count) * 1e-9, DVector::zeros(7 * count));
        for (jerk, gradient) in way.jerk.iter().zip(&way.gradient) {
            matrix.gemm_tr(1.0, gradient, gradient, 1.0);
            right.gemv_tr(-1.0, gradient, jerk, 1.0);
        }
        for (piece, amount, gradient) in &way.broken {
            let row = DVector::from_fn(7 * count, |column, _| {
                self.shapes[column / 7][*piece] * gradient[column % 7]
            });
            matrix.ger(1.0, &row, &row, 1.0);
            right.axpy(-amount, &row, 1.0);
        }
        for variable in self.moved.iter().flat_map(|shape| 7 * shape..7 * shape + 7) {
            matrix[(variable, variable)] += MOVED;
            right[variable] -= MOVED * change[variable];
        }
        for one in 0..count {
            for joint in 0..7 {
                let angles: Vec<f64> = self.postures.iter().map(|posture| posture[joint]).collect();
                let given: f64 =
                    angles.windows(4).zip(&self.jerks[one]).map(|(p, jerk)| third(p) * UNIT * jerk).sum();
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
        matrix.cholesky().map(|factors| factors.solve(&right))
    }
}

/// How far the hand is off its line, along each axis of the world, and the change of that by the joints.
fn off_line(
    guide: &Guide,
    hand: &Point3<f64>,
    jacobian: &SMatrix<f64, 3, 7>,
) -> impl Iterator<Item = (f64, Posture)> + use<> {
    let gradients = guide.across() * jacobian * OFF_LINE.sqrt();
    let gradient = move |axis: usize| std::array::from_fn(|joint| gradients[(axis, joint)]);
    let aside = guide.aside(hand).into_iter();
    aside.flat_map(move |aside| (0..3).map(move |axis| (aside[axis] * OFF_LINE.sqrt(), gradient(axis))))
}

/// Third difference of four values.
fn third(p: &[f64]) -> f64 {
    p[3] - p[0] + 3.0 * (p[1] - p[2])
}

/// With this factor the squares of third differences of a movement of 1 s add up to half the integral of its squared
/// jerk: sqrt(PIECES^5 / 2).
const UNIT: f64 = 5498.5;
