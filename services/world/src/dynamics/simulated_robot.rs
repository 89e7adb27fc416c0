use super::influence::Influence;
use super::joints::Joints;
use super::kinematic_robot::KinematicRobot;
use super::measured_grip::MeasuredGrip;
use super::physics_simulation::PhysicsSimulation;
use crate::parts::Parts;
use glam::DVec3;

/// The simulated robot, and how parts that nobody holds behave.
pub(crate) enum SimulatedRobot {
    Kinematic(KinematicRobot),
    Physics(Box<PhysicsSimulation>),
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
