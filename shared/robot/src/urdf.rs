use crate::{Joint, JointLimits, RobotError};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, UnitVector3, Vector3};
use std::path::{Path, PathBuf};

/// A URDF file, read and checked joint by joint as chains are taken from it.
#[derive(Debug, Clone)]
pub struct Urdf {
    /// The file; then those of the hands that were mounted.
    sources: Vec<Source>,
    robot: urdf_rs::Robot,
}

/// A file that links and joints come from.
#[derive(Debug, Clone)]
struct Source {
    path: PathBuf,
    text: String,
    /// What was put before its names.
    prefix: String,
}

/// Length below which an axis is none.
const NO_AXIS: f64 = 1e-9;

impl Urdf {
    /// Reads a URDF file.
    ///
    /// # Errors
    /// [`RobotError`] with the file and, where it is known, the line.
    pub fn load(path: &Path) -> Result<Self, RobotError> {
        let text = coact_input_file::read_text(path)
            .map_err(|reason| RobotError::File { path: path.to_path_buf(), reason })?;
        Self::parse(path, text)
    }

    /// Parses the text of a URDF file; `path` is only named in errors.
    ///
    /// # Errors
    /// [`RobotError::Malformed`].
    pub fn parse(path: &Path, text: String) -> Result<Self, RobotError> {
        if let Some((line, problem)) = crate::xml_line::unreadable(&text) {
            let message = format!("{problem}; expected <robot> with <link> and <joint> elements");
            return Err(RobotError::Malformed { path: path.to_path_buf(), line: Some(line), message });
        }
        match urdf_rs::read_from_string(&text) {
            Ok(robot) => {
                let source = Source { path: path.to_path_buf(), text, prefix: String::new() };
                Ok(Self { sources: vec![source], robot })
            }
            Err(error) => Err(RobotError::Malformed {
                path: path.to_path_buf(),
                line: crate::xml_line::of_first_fault(&text),
                message: format!("not a URDF: {error}; expected <robot> with <link> and <joint> elements"),
            }),
        }
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.sources[0].path
    }

    /// The file in which this link or joint is described: its own, or that of a mounted hand.
    pub fn path_of(&self, name: &str) -> &Path {
        &self.source(name).path
    }

    /// The source of a link or joint.
    fn source(&self, name: &str) -> &Source {
        self.sources.iter().rfind(|source| name.starts_with(&source.prefix)).unwrap_or(&self.sources[0])
    }

    /// This arm as part of a robot with a hand whose names begin with `prefix`.
    pub(crate) fn mounted(&self, robot: urdf_rs::Robot, hand: &Self, prefix: String) -> Self {
        let mut sources = self.sources.clone();
        sources.push(Source { prefix, ..hand.sources[0].clone() });
        Self { sources, robot }
    }

    /// The root link: the only one that is no joint's child.
    ///
    /// # Errors
    /// [`RobotError::Malformed`] when there is none, or more than one.
    pub fn root(&self) -> Result<String, RobotError> {
        let is_child = |name: &str| self.robot.joints.iter().any(|joint| joint.child.link == name);
        let mut roots = self.robot.links.iter().filter(|link| !is_child(&link.name));
        match (roots.next(), roots.next()) {
            (Some(root), None) => Ok(root.name.clone()),
            (Some(_), Some(other)) => {
                Err(self.fault(&other.name, "hangs on no joint; expected a single tree"))
            }
            (None, _) => Err(self.fault(self.name(), "has no root link; expected a tree")),
        }
    }

    /// The robot's name.
    pub fn name(&self) -> &str {
        &self.robot.name
    }

    /// All links and joints as the URDF states them.
    pub fn model(&self) -> &urdf_rs::Robot {
        &self.robot
    }

    /// The links and their inertials as the URDF states them.
    pub fn links(&self) -> &[urdf_rs::Link] {
        &self.robot.links
    }

    /// The revolute joints from the root link (or from the child link of joint `from`, when given) down to `link`,
    /// and the fixed pose of `link` after the last of them. Accelerations and jerks are infinite: a URDF has none.
    ///
    /// # Errors
    /// [`RobotError::Malformed`] when the link does not exist, the chain is broken or looped, or a joint in it is
    /// neither fixed nor revolute, has no axis, or has no usable limits.
    pub fn chain(&self, from: Option<&str>, link: &str) -> Result<(Vec<Joint>, Isometry3<f64>), RobotError> {
        let mut joints = Vec::new();
        let mut pending = Isometry3::identity();
        for joint in self.path_to(from, link)? {
            pending *= isometry(&joint.origin);
            match joint.joint_type {
                urdf_rs::JointType::Fixed => {}
                urdf_rs::JointType::Revolute | urdf_rs::JointType::Continuous => {
                    joints.push(self.revolute(joint, pending)?);
                    pending = Isometry3::identity();
                }
                ref other => {
                    return Err(self.fault(&joint.name, &format!("is {other:?}; expected revolute or fixed")));
                }
            }
        }
        Ok((joints, pending))
    }

    /// The joint that another one mimics, with multiplier and offset, rad.
    pub fn mimicked(&self, joint: &str) -> Option<(String, f64, f64)> {
        let mimic = self.robot.joints.iter().find(|known| known.name == joint)?.mimic.as_ref()?;
        Some((mimic.joint.clone(), mimic.multiplier.unwrap_or(1.0), mimic.offset.unwrap_or(0.0)))
    }

    /// URDF joints from the root (or from below joint `from`) to `link`, in order.
    fn path_to(&self, from: Option<&str>, link: &str) -> Result<Vec<&urdf_rs::Joint>, RobotError> {
        if !self.robot.links.iter().any(|known| known.name == link) {
            return Err(self.fault(link, "is not a link of this robot; check the name"));
        }
        let mut path = Vec::new();
        let mut at = link;
        while let Some(joint) = self.robot.joints.iter().find(|joint| joint.child.link == at) {
            if from == Some(joint.name.as_str()) {
                path.reverse();
                return Ok(path);
            }
            if path.len() > self.robot.joints.len() {
                return Err(self.fault(link, "lies on a loop of joints; expected a tree"));
            }
            path.push(joint);
            at = &joint.parent.link;
        }
        if let Some(from) = from {
            return Err(self.fault(from, &format!("is not a joint above link \"{link}\"")));
        }
        path.reverse();
        Ok(path)
    }

    fn revolute(&self, joint: &urdf_rs::Joint, origin: Isometry3<f64>) -> Result<Joint, RobotError> {
        let axis = UnitVector3::try_new(Vector3::from(joint.axis.xyz.0), NO_AXIS)
            .ok_or_else(|| self.fault(&joint.name, "has a zero axis; expected a direction"))?;
        if !origin.translation.vector.iter().chain(axis.iter()).all(|value| value.is_finite()) {
            return Err(self.fault(&joint.name, "has an origin or axis that is not finite"));
        }
        let urdf_rs::JointLimit { lower, upper, effort, velocity, .. } = joint.limit.clone();
        let (lower, upper) = match joint.joint_type {
            urdf_rs::JointType::Continuous => (-std::f64::consts::PI, std::f64::consts::PI),
            _ => (lower, upper),
        };
        if !(lower < upper && lower.is_finite() && upper.is_finite()) {
            return Err(self.fault(&joint.name, "needs <limit> with lower < upper, rad"));
        }
        if !(velocity > 0.0 && velocity.is_finite() && effort > 0.0 && effort.is_finite()) {
            return Err(self.fault(&joint.name, "needs <limit> with velocity and effort above zero"));
        }
        let (acceleration, jerk) = (f64::INFINITY, f64::INFINITY);
        let limits = JointLimits { lower, upper, velocity, effort, acceleration, jerk };
        Ok(Joint { name: joint.name.clone(), origin, axis, limits })
    }

    /// An error about the named element, with the line on which the name is declared.
    pub fn fault(&self, name: &str, message: &str) -> RobotError {
        let Source { path, text, prefix } = self.source(name);
        RobotError::Malformed {
            path: path.clone(),
            line: crate::xml_line::of_name(text, name.trim_start_matches(prefix.as_str())),
            message: format!("\"{name}\" {message}"),
        }
    }
}

/// A URDF pose: translation, then roll, pitch, yaw about fixed axes.
pub fn isometry(pose: &urdf_rs::Pose) -> Isometry3<f64> {
    let [roll, pitch, yaw] = pose.rpy.0;
    let [x, y, z] = pose.xyz.0;
    Isometry3::from_parts(Translation3::new(x, y, z), UnitQuaternion::from_euler_angles(roll, pitch, yaw))
}
