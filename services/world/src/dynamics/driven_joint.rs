use super::colliders::pose;
use crate::WorldError;
use coact_messages::ARM_JOINTS;
use coact_period::PERIOD_S;
use coact_robot::{MotionState, ROBOT_JOINTS, Robot};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use rapier3d::prelude::*;

/// Stiffness, 1/s², and damping, 1/s, with which the arm's joints follow their setpoints, critically damped at a natural frequency
/// of 200 rad/s. Chosen by hand.
const ARM: (f64, f64) = (40_000.0, 400.0);
/// A joint that something holds back is pushed as if to accelerate so many times as it may: less, and parts are not pressed into their
/// places; more, and a light joint is thrown when what held it gives way. Chosen by hand.
const PUSHED: f64 = 10.0;
/// A joint that was held back returns to its setpoint by so much faster than that moves, at most, rad/s: at an arm's length not faster
/// than may touch a hand (0.25 m/s). A joint that follows is never so far behind that this matters.
const RETURN: f64 = 0.3;
/// As [`ARM`], of the fingers' motors: soft enough that a part stops them before their effort is spent.
const HAND: (f64, f64) = (10_000.0, 200.0);

/// A revolute joint of the arm, one of a finger with its motor, or one that is geared to another.
#[derive(Debug, Clone)]
pub(super) struct DrivenJoint {
    pub handle: MultibodyJointHandle,
    pub name: String,
    /// Joint (message order) that it is, or that it mimics.
    pub source: usize,
    /// Whether it is that joint itself.
    pub is_source: bool,
    /// Largest torque of its motor, Nm.
    pub effort: f64,
    /// The engine has a motor for it.
    has_motor: bool,
    /// Largest acceleration that it is driven with, rad/s², and largest speed that it is driven to, rad/s.
    most_acceleration: f64,
    most_speed: f64,
    /// The URDF joint that it is geared to, and its angle for each rad of that.
    pub gear: Option<(String, f64)>,
}

impl DrivenJoint {
    /// Makes a revolute joint, with a motor when it is a finger's that is not geared to another.
    pub fn build(
        world: &mut PhysicsWorld,
        robot: &Robot,
        joint: &urdf_rs::Joint,
        (parent, child): (RigidBodyHandle, RigidBodyHandle),
        origin: Isometry3<f64>,
    ) -> Result<Self, WorldError> {
        let fault =
            |message: &str| WorldError::Robot { joint: joint.name.clone(), message: message.to_owned() };
        let named = |name: &str| (0..ROBOT_JOINTS).find(|&index| name_of(robot, index) == name);
        let own = named(&joint.name);
        let gear = robot.urdf.mimicked(&joint.name).map(|(other, factor, _)| (other, factor));
        let mimicked = gear.as_ref().and_then(|(name, _)| named(name));
        let source = own.or(mimicked).ok_or_else(|| {
            fault("is not fixed, not in the robot file, and mimics no joint that is; name it there")
        })?;
        let axis = Vector3::from(joint.axis.xyz.0);
        let align = UnitQuaternion::rotation_between(&Vector3::x(), &axis)
            .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::PI));
        let effort = joint.limit.effort;
        let data = GenericJointBuilder::new(JointAxesMask::LOCKED_REVOLUTE_AXES)
            .local_frame1(pose(&(origin * align)))
            .local_frame2(pose(&Isometry3::from_parts(Default::default(), align)));
        let motor = |data: GenericJointBuilder| {
            data.motor_model(JointAxis::AngX, MotorModel::AccelerationBased)
                .set_motor(JointAxis::AngX, 0.0, 0.0, HAND.0, HAND.1)
                .motor_max_force(JointAxis::AngX, effort)
        };
        let has_motor = gear.is_none() && source >= ARM_JOINTS;
        let data = if has_motor { motor(data) } else { data };
        let handle = world
            .insert_multibody_joint(parent, child, data.build())
            .ok_or_else(|| fault("closes a loop; expected a tree of links"))?;
        let limits = robot.limits()[source];
        Ok(Self {
            handle,
            name: joint.name.clone(),
            source,
            is_source: own.is_some(),
            effort,
            has_motor,
            most_acceleration: PUSHED * limits.acceleration,
            most_speed: limits.velocity,
            gear,
        })
    }

    /// Sets its motor, if it has one, to follow this, rad and rad/s.
    pub fn aim_motor(&self, link: &mut MultibodyLink, position: f64, velocity: f64) {
        if self.has_motor {
            link.joint.data.set_motor(JointAxis::AngX, position, velocity, HAND.0, HAND.1);
        }
    }

    /// Leaves so much torque to its motor, if it has one, Nm.
    pub fn limit_motor(&self, link: &mut MultibodyLink, torque: f64) {
        if self.has_motor {
            link.joint.data.set_motor_max_force(JointAxis::AngX, torque);
        }
    }

    /// The acceleration with which an arm's joint follows its setpoint, rad/s²: the setpoint's own, and what draws the joint to it,
    /// as it acts at the step's end (backward Euler), so that it is stable whatever the stiffness.
    ///
    /// An error beyond that at which it is pushed as hard as it may be counts as that one, however far the joint has to go; and
    /// however hard it was pushed, it returns slowly ([`RETURN`]) once it is free.
    pub fn acceleration(&self, setpoint: &MotionState, position: f64, velocity: f64) -> f64 {
        let (stiffness, damping) = ARM;
        let most_error = self.most_acceleration / stiffness;
        let error = (setpoint.position - position - PERIOD_S * velocity).clamp(-most_error, most_error);
        let drawn = setpoint.acceleration + stiffness * error + damping * (setpoint.velocity - velocity);
        let wanted = drawn / (1.0 + PERIOD_S * damping + PERIOD_S * PERIOD_S * stiffness);
        let to_speed = |speed: f64| (speed.clamp(-self.most_speed, self.most_speed) - velocity) / PERIOD_S;
        let wanted = wanted.clamp(to_speed(setpoint.velocity - RETURN), to_speed(setpoint.velocity + RETURN));
        wanted.clamp(-self.most_acceleration, self.most_acceleration)
    }

    /// The finger whose base or tip it is.
    pub fn finger(&self) -> Option<usize> {
        self.source.checked_sub(ARM_JOINTS + 1).map(|joint| joint % 3)
    }

    /// Angle for each rad of its source.
    pub fn factor(&self) -> f64 {
        if self.is_source { 1.0 } else { self.gear.as_ref().map_or(1.0, |(_, factor)| *factor) }
    }
}

fn name_of(robot: &Robot, index: usize) -> &str {
    match index.checked_sub(7) {
        None => &robot.arm().joints[index].name,
        Some(index) => &robot.hand.joints[index].name,
    }
}
