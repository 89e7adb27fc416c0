use crate::Arm;
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, UnitVector3, Vector3};
use std::f64::consts::{PI, TAU};

/// An arm posture: the seven joint angles, rad.
pub type Posture = [f64; 7];

/// All postures of one swivel angle that reach a pose: at most eight.
#[derive(Debug, Clone, Copy, Default)]
pub struct Branches {
    count: usize,
    posture: [Posture; 8],
}

impl Branches {
    /// The postures.
    pub fn as_slice(&self) -> &[Posture] {
        &self.posture[..self.count]
    }

    fn push(&mut self, posture: Posture) {
        self.posture[self.count] = posture;
        self.count += 1;
    }
}

/// Why an arm has no closed-form inverse kinematics here.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("not an S-R-S arm that is straight at zero: {0}")]
pub struct NotSrs(pub String);

/// Closed-form inverse kinematics of a seven-joint S-R-S arm, straight at zero: axes 1, 2, 3 meet in the shoulder,
/// 3, 4, 5 in the elbow, 5, 6, 7 in the wrist; odd axes lie along the straight arm, even ones across it.
///
/// The pose leaves one freedom, the *swivel angle*: the turn of the elbow about the line from shoulder to wrist,
/// 0 where the third joint stands at zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Srs {
    arm: Arm,
    /// Shoulder frame in the world: z along the straight arm, y along the second axis.
    shoulder: Isometry3<f64>,
    /// Palm frame in the wrist frame (parallel to the shoulder frame at zero).
    tool: Isometry3<f64>,
    upper_arm: f64,
    forearm: f64,
    /// Direction of each joint's axis against z (odd joints) or y (even joints).
    sign: [f64; 7],
}

/// Largest deviation from an exact S-R-S geometry, m and sine, that is still read as one: URDF files round to fractions of
/// a millimetre.
const TOLERANCE: f64 = 1e-4;
/// Distances below these (m), and sines, count as zero: a direction computed from them would be one of rounding.
const NO_DISTANCE: f64 = 1e-9;
const NO_OFFSET: f64 = 1e-12;
const NO_SINE: f64 = 1e-10;

impl Srs {
    /// Recognises the geometry of `arm`.
    ///
    /// # Errors
    /// [`NotSrs`] says which condition does not hold.
    pub fn new(arm: Arm) -> Result<Self, NotSrs> {
        if arm.joints.len() != 7 {
            return Err(NotSrs(format!("{} joints, expected 7", arm.joints.len())));
        }
        let zero = [0.0; 7];
        let frames: [Isometry3<f64>; 7] = std::array::from_fn(|index| arm.frame(&zero, index));
        let axis: [Vector3<f64>; 7] =
            std::array::from_fn(|index| frames[index].rotation * arm.joints[index].axis.into_inner());
        let at: [Vector3<f64>; 7] = std::array::from_fn(|index| frames[index].translation.vector);
        let palm = arm.palm(&zero);

        let along = UnitVector3::try_new(at[5] - at[1], TOLERANCE)
            .ok_or_else(|| NotSrs("shoulder and wrist coincide".into()))?;
        let mut sign = [0.0; 7];
        for index in 0..7 {
            let reference = if index % 2 == 0 { along.into_inner() } else { axis[1] };
            sign[index] = axis[index].dot(&reference).signum();
            if axis[index].cross(&reference).norm() > TOLERANCE {
                return Err(NotSrs(format!("axis {} is not parallel to its fellows", index + 1)));
            }
            if (at[index] - at[1]).cross(&along).norm() > TOLERANCE {
                return Err(NotSrs(format!("joint {} lies off the straight arm", index + 1)));
            }
        }
        if axis[1].dot(&along).abs() > TOLERANCE {
            return Err(NotSrs("axis 2 is not perpendicular to the straight arm".into()));
        }
        let across = (axis[1] - along.scale(axis[1].dot(&along))).normalize();
        let basis = Matrix3::from_columns(&[across.cross(&along), across, along.into_inner()]);
        let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(basis));
        let wrist = Isometry3::from_parts(Translation3::from(at[5]), rotation);
        Ok(Self {
            shoulder: Isometry3::from_parts(Translation3::from(at[1]), rotation),
            tool: wrist.inverse() * palm,
            upper_arm: (at[3] - at[1]).norm(),
            forearm: (at[5] - at[3]).norm(),
            sign,
            arm,
        })
    }

    /// The arm.
    pub fn arm(&self) -> &Arm {
        &self.arm
    }

    /// All postures within the joint limits (shrunk by `margin` rad) that put the palm at `palm` (world) with the
    /// elbow at `swivel` rad. No allocation. Empty when the pose is out of reach.
    pub fn solve(&self, palm: &Isometry3<f64>, swivel: f64, margin: f64) -> Branches {
        let mut found = Branches::default();
        let wrist = self.shoulder.inverse() * palm * self.tool.inverse();
        let line = wrist.translation.vector;
        let (a, b) = (self.upper_arm, self.forearm);
        let cosine = (line.norm_squared() - a * a - b * b) / (2.0 * a * b);
        if !(-1.0..=1.0).contains(&cosine) || line.norm() < NO_DISTANCE {
            return found;
        }
        let target = wrist.rotation.to_rotation_matrix();
        for elbow in [cosine.acos(), -cosine.acos()] {
            let upper = self.upper_arm_rotation(&line, elbow, swivel);
            let lower = (upper * Rotation3::from_axis_angle(&Vector3::y_axis(), elbow)).inverse() * target;
            for [q1, q2, q3] in euler_zyz(&upper) {
                for [q5, q6, q7] in euler_zyz(&lower) {
                    if let Some(posture) = self.fit([q1, q2, q3, elbow, q5, q6, q7], margin) {
                        found.push(posture);
                    }
                }
            }
        }
        found
    }

    /// Rotation of the upper arm (after joint 3) that, with the elbow bent by `elbow`, puts the wrist at `line` from
    /// the shoulder, turned about that line by `swivel`.
    fn upper_arm_rotation(&self, line: &Vector3<f64>, elbow: f64, swivel: f64) -> Rotation3<f64> {
        let bent = (self.forearm * elbow.sin()).atan2(self.upper_arm + self.forearm * elbow.cos());
        let raised = line.x.hypot(line.y).atan2(line.z) - bent;
        let turned = if line.x.hypot(line.y) > NO_OFFSET { line.y.atan2(line.x) } else { 0.0 };
        let reference = Rotation3::from_axis_angle(&Vector3::z_axis(), turned)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), raised);
        Rotation3::from_axis_angle(&UnitVector3::new_normalize(*line), swivel) * reference
    }

    /// Angles in the joints' own senses, moved by whole turns into the limits.
    fn fit(&self, angles: Posture, margin: f64) -> Option<Posture> {
        let mut posture = [0.0; 7];
        for (index, joint) in self.arm.joints.iter().enumerate() {
            let middle = 0.5 * (joint.limits.lower + joint.limits.upper);
            let angle = self.sign[index] * angles[index];
            posture[index] = angle - TAU * ((angle - middle) / TAU).round();
            if !joint.limits.contain(posture[index], margin) {
                return None;
            }
        }
        Some(posture)
    }
}

/// The two sets of angles with Rz(a) Ry(b) Rz(c) = `rotation`; where b vanishes, all of the turn goes into c.
fn euler_zyz(rotation: &Rotation3<f64>) -> [[f64; 3]; 2] {
    let m = rotation.matrix();
    let sine = m[(0, 2)].hypot(m[(1, 2)]);
    if sine < NO_SINE {
        let straight = if m[(2, 2)] > 0.0 { 0.0 } else { PI };
        let turn = m[(1, 0)].atan2(m[(1, 1)]);
        return [[0.0, straight, turn], [PI, -straight, turn - PI]];
    }
    let (a, b, c) = (m[(1, 2)].atan2(m[(0, 2)]), sine.atan2(m[(2, 2)]), m[(2, 1)].atan2(-m[(2, 0)]));
    [[a, b, c], [a + PI, -b, c + PI]]
}
