//! The robot that obeys the commands, and the loose parts: without dynamics, or by rigid-body dynamics.

mod articulation;
mod articulation_build;
mod clasp;
mod colliders;
mod contacts;
mod driven_joint;
mod finger_stop;
mod fixtures;
mod force_sensor;
mod influence;
mod inverse_dynamics;
mod joints;
mod kinematic_robot;
mod layer;
mod link_body;
mod measured_grip;
mod person_grip;
mod physics_simulation;
mod simulated_robot;

pub(crate) use finger_stop::FingerStop;
pub(crate) use influence::Influence;
pub(crate) use joints::Joints;
pub(crate) use measured_grip::MeasuredGrip;
pub(crate) use simulated_robot::SimulatedRobot;
