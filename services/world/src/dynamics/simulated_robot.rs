use super::influence::Influence;
use super::joints::Joints;
use super::kinematic_robot::KinematicRobot;
use super::measured_grip::MeasuredGrip;
use super::physics_simulation::PhysicsSimulation;
use crate::WorldError;
use crate::parts::Parts;
use coact_joint_task::Task;
use coact_pipeline::WorldMode;
use coact_robot::Robot;
use glam::{DQuat, DVec3};

/// The simulated robot, and how parts that nobody holds behave.
pub(crate) enum SimulatedRobot {
    Kinematic(KinematicRobot),
    Physics(Box<PhysicsSimulation>),
}

impl SimulatedRobot {
    /// A robot whose joints and parts are where they are said to be.
    ///
    /// # Errors
    /// [`WorldError`] when the scene or the robot cannot be simulated with dynamics.
    pub fn new(
        mode: WorldMode,
        task: &Task,
        robot: &Robot,
        joints: &Joints,
        parts: &Parts,
    ) -> Result<Self, WorldError> {
        Ok(match mode {
            WorldMode::Kinematic => Self::Kinematic(KinematicRobot::new()),
            WorldMode::Physics => {
                Self::Physics(Box::new(PhysicsSimulation::new(task, robot, joints, parts)?))
            }
        })
    }

    /// So many steps are taken when so many ticks have passed.
    pub fn steps(&self, passed: u64) -> u64 {
        match self {
            Self::Kinematic(_) => passed,
            Self::Physics(_) => 1,
        }
    }

    /// Moves joints and loose parts by one step.
    pub fn advance(&mut self, influence: &Influence, joints: &mut Joints, parts: &mut Parts) {
        match self {
            Self::Kinematic(robot) => robot.advance(influence, joints, parts),
            Self::Physics(robot) => {
                robot.advance(influence, joints, parts);
            }
        }
    }

    /// The person's hand has the part there: it is there, or with dynamics on its way.
    pub fn carry(&mut self, part: usize, position: DVec3, orientation: DQuat, parts: &mut Parts) {
        match self {
            Self::Kinematic(_) => parts.place(part, position, orientation),
            Self::Physics(robot) => robot.carry(part, position, orientation),
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
