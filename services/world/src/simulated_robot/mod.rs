//! The robot that obeys the commands, and the loose parts: without dynamics, or by rigid-body dynamics.

mod articulation;
mod clasp;
mod contacts;
mod finger_stop;
mod fixtures;
mod force_sensor;
mod kinematic_robot;
mod measured_grip;
mod physics_simulation;
mod shapes;

pub(crate) use finger_stop::FingerStop;
pub(crate) use kinematic_robot::KinematicRobot;
pub(crate) use measured_grip::MeasuredGrip;
pub(crate) use physics_simulation::PhysicsSimulation;

use crate::parts::Parts;
use coact_joint_task::Task;
use coact_messages::{Command, JOINTS};
use glam::DVec3;

/// Measured joint positions, rad, and velocities, rad/s, in message order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Joints {
    pub position: [f64; JOINTS],
    pub velocity: [f64; JOINTS],
}

/// The simulated robot, and how parts that nobody holds behave.
pub(crate) enum SimulatedRobot {
    Kinematic(KinematicRobot),
    Physics(Box<PhysicsSimulation>),
}

/// What robot and parts are moved by in one step.
#[derive(Clone, Copy)]
pub(crate) struct Influence<'a> {
    /// Ticks since the step before.
    pub elapsed: u64,
    pub command: Option<&'a Command>,
    pub stop: FingerStop,
    pub task: &'a Task,
    /// The person's hand, m.
    pub person: DVec3,
    /// The part in the robot's hand.
    pub held: Option<usize>,
    /// The part that has slipped out of the robot's hand, whose fingers are still closed.
    pub slipped: Option<usize>,
    /// Force of the person on the part in the robot's hand, N.
    pub pull: DVec3,
}

impl SimulatedRobot {
    /// Moves joints and loose parts by one step.
    pub fn advance(&mut self, influence: &Influence, joints: &mut Joints, parts: &mut Parts) {
        match self {
            Self::Kinematic(robot) => robot.advance(influence, joints, parts),
            Self::Physics(robot) => {
                robot.advance(influence, joints, parts);
            }
        }
    }

    /// What the fingers are measured to squeeze; none without dynamics, where nothing is
    /// measured.
    pub fn grip(&self) -> Option<MeasuredGrip> {
        match self {
            Self::Kinematic(_) => None,
            Self::Physics(robot) => Some(robot.grip()),
        }
    }

    /// Force on the robot's hand and what it holds, by anything but the person's rules, N; none without dynamics, where
    /// nothing is measured.
    pub fn outside(&self) -> Option<DVec3> {
        match self {
            Self::Kinematic(_) => None,
            Self::Physics(robot) => Some(robot.outside()),
        }
    }

    /// Takes over joints and parts from a world that was killed.
    pub fn resume(&mut self, joints: &Joints, parts: &Parts) {
        match self {
            Self::Kinematic(_) => {}
            Self::Physics(robot) => robot.resume(joints, parts),
        }
    }
}
