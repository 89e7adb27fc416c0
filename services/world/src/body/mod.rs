//! What obeys the robot's commands: a body without dynamics, or a simulated one.

mod articulation;
mod clasp;
mod contacts;
mod finger_stop;
mod force_sensor;
mod grip;
mod kinematic;
mod physics;
mod scene;
mod shapes;

pub(crate) use finger_stop::FingerStop;
pub(crate) use grip::Grip;
pub(crate) use kinematic::Kinematic;
pub(crate) use physics::Physics;

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

/// The robot's body, and how parts that nobody holds behave.
pub(crate) enum Body {
    Kinematic(Kinematic),
    Physics(Box<Physics>),
}

/// What a body is moved by in one step.
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

impl Body {
    /// Moves joints and loose parts by one step.
    pub fn advance(&mut self, influence: &Influence, joints: &mut Joints, parts: &mut Parts) {
        match self {
            Self::Kinematic(body) => body.advance(influence, joints, parts),
            Self::Physics(body) => {
                body.advance(influence, joints, parts);
            }
        }
    }

    /// What the fingers are measured to squeeze; none for a body that measures nothing.
    pub fn grip(&self) -> Option<Grip> {
        match self {
            Self::Kinematic(_) => None,
            Self::Physics(body) => Some(body.grip()),
        }
    }

    /// Force on the robot's hand and what it holds, by anything but the person's rules, N; none for a body that measures
    /// nothing.
    pub fn outside(&self) -> Option<DVec3> {
        match self {
            Self::Kinematic(_) => None,
            Self::Physics(body) => Some(body.outside()),
        }
    }

    /// Takes over joints and parts from a world that was killed.
    pub fn resume(&mut self, joints: &Joints, parts: &Parts) {
        match self {
            Self::Kinematic(_) => {}
            Self::Physics(body) => body.resume(joints, parts),
        }
    }
}
