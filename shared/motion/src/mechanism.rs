use crate::{CollisionModel, Link, SearchHeartbeat, collision_geometry};
use coact_robot::{
    Arm, HAND_JOINTS, Hand, HandGoal, JointLimits, Posture, Robot, RobotError, Srs, Urdf, grip_frame,
};
use nalgebra::{Isometry3, Translation3, Vector3};

/// Most joints of an arm that is planned for.
pub const MAX_JOINTS: usize = 7;

/// An arm of six or seven joints with a hand, as the planner sees it: kinematics, limits and collision geometry.
#[derive(Debug, Clone)]
pub struct Mechanism {
    /// The robot's name in its URDF.
    pub name: String,
    /// The arm, from the world to the palm; accelerations and jerks are limited, too.
    pub arm: Arm,
    /// Closed-form inverse kinematics, where the arm is S-R-S.
    pub closed_form: Option<Srs>,
    /// Posture at rest, rad; beyond the arm's own joints 0.
    pub park: Posture,
    /// Distance of the grasp point from the palm along the palm's z axis, m.
    pub grasp_distance: f64,
    pub(crate) urdf: Urdf,
    pub(crate) meshes: Meshes,
    /// Beats whenever a search looks at a posture of this mechanism: in the innermost loop of each.
    pub(crate) heartbeat: SearchHeartbeat,
}

/// What to do about a mesh file that is not there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Meshes {
    /// Refuse the robot.
    Required,
    /// A capsule of this radius, m, from the link's frame to the next joint, stands in for it; in fingers one of a sixth of
    /// that radius.
    OrCapsules(f64),
}

/// Limits of acceleration (rad/s²) and jerk (rad/s³) of joints whose files state none: those of the robot ARoS, with which
/// a reach takes one to two seconds.
const USUAL: (f64, f64) = (10.0, 200.0);
/// Bend of the fourth joint (the elbow of an arm of seven) in the park posture of a robot that states none, rad: half of
/// this, or of the upper limit where that is less. Chosen by hand: the arm is neither straight nor folded.
const ELBOW: f64 = 1.6;
/// Where the finger tips of a hand meet that does not state it, as a fraction of the fingers' length. Chosen by hand:
/// fingers that bend inwards meet nearer to the palm than they are long.
const MEETING: f64 = 0.6;

impl Mechanism {
    /// The robot that a robot file describes.
    ///
    /// # Errors
    /// [`RobotError`] when its collision geometry cannot be used.
    pub fn of(robot: &Robot) -> Result<Self, RobotError> {
        let mechanism = Self {
            name: robot.name.clone(),
            arm: robot.arm().clone(),
            closed_form: Some(robot.kinematics.clone()),
            park: robot.park,
            grasp_distance: robot.hand.grasp_distance,
            urdf: robot.urdf.clone(),
            meshes: Meshes::Required,
            heartbeat: SearchHeartbeat::default(),
        };
        collision_geometry::arm_links(&mechanism)?;
        Ok(mechanism)
    }

    /// The same mechanism, whose searches beat with this heartbeat.
    #[must_use]
    pub fn beating(self, heartbeat: SearchHeartbeat) -> Self {
        Self { heartbeat, ..self }
    }

    /// A robot that only a URDF describes. Its palm is the link from which fingers branch off; its park posture is the
    /// middle of all joint ranges, with the elbow bent.
    ///
    /// # Errors
    /// [`RobotError`] with file and line: a broken URDF, a hand without fingers, an arm of other than six or seven
    /// joints, limits reversed or zero, a missing mesh.
    pub fn from_urdf(urdf: Urdf, meshes: Meshes) -> Result<Self, RobotError> {
        let palm = urdf.palm()?;
        let (mut joints, tool) = urdf.chain(None, &palm)?;
        is_an_arm(&urdf, &palm, joints.len())?;
        for joint in &mut joints {
            (joint.limits.acceleration, joint.limits.jerk) = USUAL;
        }
        let grasp_distance = grasp_distance(&urdf, &palm, joints.len())?;
        let arm = Arm { joints, tool };
        let closed_form = if arm.joints.len() == 7 { Srs::new(arm.clone()).ok() } else { None };
        let mut park = [0.0; 7];
        for (angle, joint) in park.iter_mut().zip(&arm.joints) {
            *angle = 0.5 * (joint.limits.lower + joint.limits.upper);
        }
        park[3] = 0.5 * arm.joints[3].limits.upper.clamp(0.0, ELBOW);
        let name = urdf.name().to_owned();
        let heartbeat = SearchHeartbeat::default();
        let mechanism = Self { name, arm, closed_form, park, grasp_distance, urdf, meshes, heartbeat };
        collision_geometry::arm_links(&mechanism)?;
        Ok(mechanism)
    }

    /// The same arm with the hand of another URDF, which stands where the palm stood.
    ///
    /// # Errors
    /// [`RobotError`] with file and line: a hand without fingers, limits reversed or zero, a missing mesh.
    pub fn with_hand(self, hand: &Urdf, meshes: Meshes) -> Result<Self, RobotError> {
        let urdf = self.urdf.with_hand(hand)?;
        let palm = urdf.palm()?;
        let (joints, tool) = urdf.chain(None, &palm)?;
        if joints.len() > self.joints() {
            return Err(
                urdf.fault(&palm, "hangs on joints of its own; expected a hand whose fingers alone move")
            );
        }
        let grasp_distance = grasp_distance(&urdf, &palm, joints.len())?;
        let arm = Arm { joints: self.arm.joints, tool };
        let closed_form = self.closed_form.and_then(|_| Srs::new(arm.clone()).ok());
        let name = urdf.name().to_owned();
        let (park, heartbeat) = (self.park, self.heartbeat);
        let mechanism = Self { name, arm, closed_form, park, grasp_distance, urdf, meshes, heartbeat };
        collision_geometry::arm_links(&mechanism)?;
        Ok(mechanism)
    }

    /// Joints of the arm.
    pub fn joints(&self) -> usize {
        self.arm.joints.len()
    }

    /// Limits of the arm's joints; those of unused joints only fill their places.
    pub fn limits(&self) -> [JointLimits; MAX_JOINTS] {
        let unused =
            JointLimits { lower: -1.0, upper: 1.0, velocity: 1.0, effort: 1.0, acceleration: 1.0, jerk: 1.0 };
        std::array::from_fn(|joint| self.arm.joints.get(joint).map_or(unused, |joint| joint.limits))
    }

    /// The collision model of arm and hand with the fingers at these angles, rad, by joint name; joints that mimic others
    /// follow them.
    ///
    /// # Errors
    /// [`RobotError`] when a link's collision geometry cannot be used.
    pub fn collision_model(&self, fingers: &dyn Fn(&str) -> f64) -> Result<CollisionModel, RobotError> {
        let mut links = collision_geometry::arm_links(self)?;
        links.extend(collision_geometry::hand_links(self, fingers)?);
        Ok(CollisionModel::new(self, links))
    }

    /// The same with the joints of a hand from a robot file at these angles, rad, in message order.
    ///
    /// # Errors
    /// As [`collision_model`](Self::collision_model).
    pub fn with_fingers(
        &self,
        hand: &Hand,
        angles: &[f64; HAND_JOINTS],
    ) -> Result<CollisionModel, RobotError> {
        self.with_moving_fingers(hand, &[*angles])
    }

    /// The same with fingers that pass through all of these shapes of the hand, and those between them, while the arm
    /// reaches. While the hand leaves it has the first shape, while it approaches the last.
    ///
    /// # Errors
    /// As [`collision_model`](Self::collision_model).
    pub fn with_moving_fingers(
        &self,
        hand: &Hand,
        shapes: &[[f64; HAND_JOINTS]],
    ) -> Result<CollisionModel, RobotError> {
        let passed = collision_geometry::passed(shapes);
        let hands = passed.iter().map(|angles| collision_geometry::hand_links(self, &named(hand, angles)));
        let hands: Vec<Vec<Link>> = hands.collect::<Result<_, _>>()?;
        let mut links = collision_geometry::arm_links(self)?;
        for number in 0..hands.first().map_or(0, Vec::len) {
            let stands = hands.iter().all(|hand| hand[number].place == hands[0][number].place);
            let count = if stands { 1 } else { hands.len() };
            links.extend(hands[..count].iter().enumerate().map(|(index, hand)| {
                let segments = [index == 0, true, index + 1 == count];
                Link { segments, ..hand[number].clone() }
            }));
        }
        Ok(CollisionModel::new(self, links))
    }

    /// The grasp point in the palm frame.
    pub fn grasp_point(&self) -> nalgebra::Point3<f64> {
        nalgebra::Point3::new(0.0, 0.0, self.grasp_distance)
    }

    /// The goal that is reached with the palm there, and with no other roll.
    pub(crate) fn goal_of(&self, palm: &Isometry3<f64>) -> HandGoal {
        HandGoal {
            point: palm * self.grasp_point(),
            approach: palm.rotation * Vector3::z(),
            closing_axis: palm.rotation * Vector3::x(),
            rolls: 1,
            along: palm.rotation * Vector3::z(),
            back: 0.0,
            floor: f64::NEG_INFINITY,
        }
    }

    /// Palm pose at a goal, turned by `roll` rad about the approach, `back` m before it.
    pub(crate) fn palm_at(&self, goal: &HandGoal, roll: f64, back: f64) -> Isometry3<f64> {
        let point = goal.point - goal.along * back;
        let grip = grip_frame(&point, &goal.approach, &goal.closing_axis, roll);
        grip * Translation3::new(0.0, 0.0, -self.grasp_distance)
    }
}

/// Angles by the names of the hand's joints, rad; 0 for a joint that is not the hand's.
fn named<'a>(hand: &'a Hand, angles: &'a [f64; HAND_JOINTS]) -> impl Fn(&str) -> f64 + 'a {
    |name| hand.joints.iter().position(|joint| joint.name == name).map_or(0.0, |index| angles[index])
}

/// Refuses what has too few or too many joints before its palm.
fn is_an_arm(urdf: &Urdf, palm: &str, joints: usize) -> Result<(), RobotError> {
    match joints {
        0 => Err(urdf.fault(
            palm,
            "carries fingers, but no joints of an arm lead to it: this is a hand alone; give it with --hand FILE and an \
             arm with --robot FILE",
        )),
        6..=MAX_JOINTS => Ok(()),
        _ => Err(urdf.fault(palm, &format!("ends an arm of {joints} joints; expected six or seven"))),
    }
}

/// Distance from the palm at which fingers of this length meet, m.
fn grasp_distance(urdf: &Urdf, palm: &str, arm_joints: usize) -> Result<f64, RobotError> {
    Ok(MEETING * collision_geometry::finger_length(urdf, palm, arm_joints)?)
}
