use crate::config::{Config, HandConfig};
use crate::{Arm, Finger, HAND_JOINTS, Hand, Joint, JointLimits, Posture, RobotError, Srs, Urdf};
use nalgebra::{Isometry3, Point3, Vector3};
use std::path::Path;

/// Joints of arm and hand in message order: seven arm joints, then spread, three finger bases, three finger tips.
pub const ROBOT_JOINTS: usize = 7 + HAND_JOINTS;

/// An arm with a hand: geometry, limits, inverse kinematics and park posture.
#[derive(Debug, Clone)]
pub struct Robot {
    /// The robot's name in its URDF.
    pub name: String,
    /// Inverse kinematics of the arm.
    pub kinematics: Srs,
    /// The hand.
    pub hand: Hand,
    /// Arm posture at rest, rad.
    pub park: Posture,
    /// The URDF that all this was read from: masses and shapes of the links are found there.
    pub urdf: Urdf,
    /// Acceleration, rad/s², and jerk, rad/s³, that the arm's joints can bear.
    most: [(f64, f64); 7],
}

impl Robot {
    /// Reads a robot file (TOML: URDF, joint names, acceleration and jerk limits, park posture) and its URDF.
    ///
    /// # Errors
    /// [`RobotError`] with file, line where it is known, what was found and what was expected.
    pub fn load(path: &Path) -> Result<Self, RobotError> {
        let config = Config::load(path)?;
        let urdf = Urdf::load(&path.with_file_name(&config.urdf))?;
        let arm = arm(path, &config, &urdf)?;
        let hand = hand(path, &config, &urdf)?;
        let kinematics = Srs::new(arm).map_err(|error| urdf.fault(&config.palm, &error.to_string()))?;
        if !kinematics.arm().within_limits(&config.arm.park, 0.0) {
            return Err(Config::fault(
                path,
                "park",
                "lies outside the joint limits of the URDF; choose it within",
            ));
        }
        let most =
            std::array::from_fn(|joint| (config.arm.most_acceleration[joint], config.arm.most_jerk[joint]));
        Ok(Self { name: urdf.name().to_owned(), kinematics, hand, park: config.arm.park, urdf, most })
    }

    /// The arm.
    pub fn arm(&self) -> &Arm {
        self.kinematics.arm()
    }

    /// Pose of the palm in the world; `angles` in message order.
    pub fn palm(&self, angles: &[f64]) -> Isometry3<f64> {
        self.arm().palm(angles)
    }

    /// The grasp point in the world, m; `angles` in message order.
    pub fn grasp_point(&self, angles: &[f64]) -> Point3<f64> {
        self.palm(angles) * self.hand.grasp_point()
    }

    /// What all joints can bear, in message order: whoever drives them keeps within it, and brakes with it.
    pub fn limits(&self) -> [JointLimits; ROBOT_JOINTS] {
        let mut limits = self.planned_limits();
        for (limits, most) in limits.iter_mut().zip(self.most) {
            (limits.acceleration, limits.jerk) = most;
        }
        limits
    }

    /// Limits of planned movements, of all joints in message order.
    pub fn planned_limits(&self) -> [JointLimits; ROBOT_JOINTS] {
        std::array::from_fn(|index| match index.checked_sub(7) {
            None => self.arm().joints[index].limits,
            Some(index) => self.hand.joints[index].limits,
        })
    }
}

fn arm(path: &Path, config: &Config, urdf: &Urdf) -> Result<Arm, RobotError> {
    let (mut joints, tool) = urdf.chain(None, &config.palm)?;
    if !joints.iter().map(|joint| &joint.name).eq(&config.arm.joints) {
        let found: Vec<_> = joints.iter().map(|joint| joint.name.as_str()).collect();
        return Err(Config::fault(
            path,
            "joints",
            &format!("expected the joints of the URDF down to the palm: {found:?}"),
        ));
    }
    for (index, joint) in joints.iter_mut().enumerate() {
        joint.limits.acceleration = config.arm.acceleration[index];
        joint.limits.jerk = config.arm.jerk[index];
    }
    Ok(Arm { joints, tool })
}

fn hand(path: &Path, config: &Config, urdf: &Urdf) -> Result<Hand, RobotError> {
    let fingers = fingers(path, config, urdf)?;
    let names = &config.hand;
    let pick = |name: &String| {
        let mut all = fingers.iter().flat_map(|finger| &finger.joints);
        all.find(|joint| &joint.name == name).cloned().map(|joint| limited(joint, config))
    };
    let names = std::iter::once(&names.spread).chain(&names.bases).chain(&names.tips);
    let joints: Option<Vec<Joint>> = names.map(pick).collect();
    let joints = joints.ok_or_else(|| Config::fault(path, "spread", "is not a joint of any finger"))?;
    let coupling = urdf.mimicked(&config.hand.tips[0]).map_or(0.0, |(_, factor, _)| factor);
    let HandConfig { grasp_spread, pad, grasp_distance, .. } = config.hand;
    let [_, half_breadth, palm_face] = extent(urdf, &config.palm);
    let middle = urdf.model().joints.iter().filter(|joint| joint.name == config.hand.tips[2]);
    let middle = middle.map(|joint| extent(urdf, &joint.child.link)[1]).fold(0.0, f64::max);
    let interlaces = fingers[0].joints[0].origin.translation.y.abs() - pad[0] > middle;
    let mut hand = Hand {
        joints,
        fingers,
        coupling,
        grasp_spread,
        pad,
        grasp_distance,
        palm_face,
        interlaces,
        half_breadth,
    };
    hand.half_breadth = hand.half_breadth.max(hand.reach_aside());
    Ok(hand)
}

/// The chains of the three fingers from the palm frame.
fn fingers(path: &Path, config: &Config, urdf: &Urdf) -> Result<[Finger; 3], RobotError> {
    let names = &config.hand;
    let last_arm_joint = config.arm.joints.last().map(String::as_str);
    let mut fingers = Vec::with_capacity(3);
    for finger in 0..3 {
        let (joints, end) = urdf.chain(last_arm_joint, &names.ends[finger])?;
        let tail = joints.len().saturating_sub(2);
        let expected = [&names.bases[finger], &names.tips[finger]];
        if !joints[tail..].iter().map(|joint| &joint.name).eq(expected) || tail > 1 {
            let message = "each finger must be an optional spread, a base and a tip joint";
            return Err(Config::fault(path, "ends", message));
        }
        fingers.push(Finger { joints, end });
    }
    let fingers: [Finger; 3] =
        fingers.try_into().map_err(|_| Config::fault(path, "ends", "expected three fingers"))?;
    let (_, palm) = urdf.chain(None, &config.palm)?;
    Ok(fingers.map(|finger| from_palm(finger, &palm)))
}

/// How far the forms of a link reach along its axes, m. (Meshes are not read here.)
fn extent(urdf: &Urdf, link: &str) -> [f64; 3] {
    use urdf_rs::Geometry::{Box, Capsule, Cylinder, Mesh, Sphere};
    let shapes = urdf.links().iter().filter(|known| known.name == link).flat_map(|link| &link.collision);
    shapes.fold([0.0; 3], |largest, shape| {
        let half = match &shape.geometry {
            Box { size } => 0.5 * Vector3::from(size.0),
            Cylinder { radius, length } => Vector3::new(*radius, *radius, 0.5 * length),
            Capsule { radius, length } => Vector3::new(*radius, *radius, radius + 0.5 * length),
            Sphere { radius } => Vector3::repeat(*radius),
            Mesh { .. } => return largest,
        };
        let place = crate::isometry(&shape.origin);
        let turned = place.rotation.to_rotation_matrix().into_inner().abs() * half;
        std::array::from_fn(|axis| largest[axis].max(place.translation.vector[axis] + turned[axis]))
    })
}

/// A finger's chain below the last arm joint, seen from the palm frame instead.
fn from_palm(mut finger: Finger, palm: &Isometry3<f64>) -> Finger {
    if let Some(first) = finger.joints.first_mut() {
        first.origin = palm.inverse() * first.origin;
    }
    finger
}

fn limited(mut joint: Joint, config: &Config) -> Joint {
    joint.limits.acceleration = config.hand.acceleration;
    joint.limits.jerk = config.hand.jerk;
    joint
}
