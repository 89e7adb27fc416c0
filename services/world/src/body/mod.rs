//! What obeys the robot's commands: a body without dynamics, or a simulated one.

mod kinematic;

pub(crate) use kinematic::Kinematic;

use crate::parts::Parts;
use coact_messages::{Command, JOINTS};

/// Measured joint positions, rad, and velocities, rad/s, in message order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Joints {
    pub position: [f64; JOINTS],
    pub velocity: [f64; JOINTS],
}

/// The robot's body, and how parts that nobody holds behave.
pub(crate) enum Body {
    Kinematic(Kinematic),
}

impl Body {
    /// Moves the joints by one step of `elapsed` ticks towards the command; fingers on a part stop at `finger_stop`.
    pub fn advance(
        &mut self,
        elapsed: u64,
        command: Option<&Command>,
        finger_stop: Option<f64>,
        joints: &mut Joints,
        parts: &mut Parts,
    ) {
        match self {
            Self::Kinematic(body) => body.advance(elapsed, command, finger_stop, joints, parts),
        }
    }

    /// Takes over joints and parts from a world that was killed.
    pub fn resume(&mut self, _joints: &Joints, _parts: &Parts) {
        match self {
            Self::Kinematic(_) => {}
        }
    }
}
