use super::{
    BEYOND_LIMIT, FROM_LIMITS, JERK_SCALE, JOINTS, MOVED, OFF_LINE, PIECES, Smoothing, TOO_NEAR,
    third_difference,
};
use crate::frames::Frames;
use crate::line_constraint::LineConstraint;
use crate::posture_cost::WEIGHT;
use coact_robot::Posture;
use nalgebra::{DVector, Matrix3xX, Point3, SMatrix, Vector3};

/// A changed movement: its merit, and what the next step needs to know of it.
pub(super) struct Evaluation {
    /// What is made least: the squared normalised jerk of the hand, that of the joints, and the penalties.
    pub merit: f64,
    /// Jerks of the hand over the length of its path, and their gradients.
    pub jerk: Vec<Vector3<f64>>,
    pub gradient: Vec<Matrix3xX<f64>>,
    pub violations: Vec<Violation>,
}

/// A constraint that is not kept.
pub(super) struct Violation {
    /// The step of time at which.
    pub piece: usize,
    /// By how much, times the root of its penalty.
    pub amount: f64,
    /// The gradient of that by the joints.
    pub gradient: Posture,
}

/// Shortest path of the hand by which its jerk is divided, m: it guards the division where the hand only turns.
const SHORTEST_PATH: f64 = 1e-3;

impl Smoothing<'_> {
    /// The movement with this change.
    pub(super) fn evaluate(&self, change: &DVector<f64>) -> Evaluation {
        let joints = self.mechanism.joints();
        let count = self.shapes.len();
        let postures = self.changed(change);
        let mut places = Vec::with_capacity(PIECES + 1);
        let mut gradients = Vec::with_capacity(PIECES + 1);
        let mut violations = self.violations(&postures);
        for (piece, posture) in postures.iter().enumerate() {
            let frames = Frames::of(self.mechanism, posture);
            let palm = frames.pose[joints - 1] * self.mechanism.arm.tool;
            let hand = palm * self.mechanism.grasp_point();
            let jacobian = frames.jacobian(&hand, joints);
            let mut gradient = Matrix3xX::zeros(7 * count);
            for (shape, values) in self.shapes.iter().enumerate() {
                gradient.fixed_columns_mut::<7>(7 * shape).copy_from(&(values[piece] * jacobian));
            }
            for line in self.lines.iter().filter(|line| line.segment == self.segments[piece]) {
                let places = line.places(&palm);
                violations.extend(
                    places.flat_map(|place| off_line(line, piece, &place, &frames.jacobian(&place, joints))),
                );
            }
            places.push(hand.coords);
            gradients.push(gradient);
        }
        let length: f64 = places.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        let unit = JERK_SCALE / length.max(SHORTEST_PATH);
        let jerk: Vec<_> = places.windows(4).map(|p| (p[3] - p[0] + 3.0 * (p[1] - p[2])) * unit).collect();
        let gradient = gradients.windows(4).map(|p| (&p[3] - &p[0] + 3.0 * (&p[1] - &p[2])) * unit).collect();
        let moved = self.moved.iter().map(|shape| change.rows(7 * shape, 7).norm_squared());
        let merit = MOVED * moved.sum::<f64>()
            + jerk.iter().map(Vector3::norm_squared).sum::<f64>()
            + JOINTS * joint_jerk(&postures)
            + violations.iter().map(|violation| violation.amount * violation.amount).sum::<f64>();
        Evaluation { merit, jerk, gradient, violations }
    }

    fn changed(&self, change: &DVector<f64>) -> Vec<Posture> {
        let angle = |piece: usize, joint: usize| {
            let shapes = self.shapes.iter().enumerate();
            let changes = shapes.map(|(shape, values)| values[piece] * change[7 * shape + joint]);
            self.postures[piece][joint] + changes.sum::<f64>()
        };
        (0..=PIECES).map(|piece| std::array::from_fn(|joint| angle(piece, joint))).collect()
    }

    /// Position limits and clearances that are not kept.
    fn violations(&self, postures: &[Posture]) -> Vec<Violation> {
        let mut violations = Vec::new();
        let mut near = Vec::new();
        for (piece, posture) in postures.iter().enumerate() {
            violations.extend(self.beyond_limits(piece, posture));
            let (clearance, required) = &self.required[piece];
            clearance.near(posture, *required, &mut near);
            violations.extend(near.iter().map(|near| Violation {
                piece,
                amount: (required - near.distance) * TOO_NEAR.sqrt(),
                gradient: near.gradient.map(|gradient| -gradient * TOO_NEAR.sqrt()),
            }));
        }
        violations
    }

    fn beyond_limits(&self, piece: usize, posture: &Posture) -> impl Iterator<Item = Violation> {
        let limits = self.mechanism.arm.joints.iter().map(|joint| joint.limits);
        limits.zip(*posture).enumerate().flat_map(move |(joint, (limit, angle))| {
            let (below, above) = (limit.lower + FROM_LIMITS - angle, angle - limit.upper + FROM_LIMITS);
            let broken = [(below, -1.0), (above, 1.0)].into_iter().filter(|(excess, _)| *excess > 0.0);
            broken.map(move |(excess, sign)| {
                let mut gradient = [0.0; 7];
                gradient[joint] = sign * BEYOND_LIMIT.sqrt();
                Violation { piece, amount: excess * BEYOND_LIMIT.sqrt(), gradient }
            })
        })
    }
}

/// Weighted squared jerk of the joints.
fn joint_jerk(postures: &[Posture]) -> f64 {
    (0..7)
        .map(|joint| {
            let angles: Vec<f64> = postures.iter().map(|posture| posture[joint]).collect();
            let squares = angles.windows(4).map(|p| (third_difference(p) * JERK_SCALE).powi(2));
            WEIGHT[joint] * squares.sum::<f64>()
        })
        .sum()
}

/// How far this place of the hand is off its line, along each axis of the world.
fn off_line(
    line: &LineConstraint,
    piece: usize,
    place: &Point3<f64>,
    jacobian: &SMatrix<f64, 3, 7>,
) -> impl Iterator<Item = Violation> + use<> {
    let gradients = line.across() * jacobian * OFF_LINE.sqrt();
    let offset = line.offset(place);
    (0..3).map(move |axis| Violation {
        piece,
        amount: offset[axis] * OFF_LINE.sqrt(),
        gradient: std::array::from_fn(|joint| gradients[(axis, joint)]),
    })
}
