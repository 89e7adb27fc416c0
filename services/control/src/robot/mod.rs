//! The robot as control needs it: its limits, the shapes of its fingers, its grips, its collision models.

mod collision_models;
mod finger_shape;
mod grip_table;
mod part_grip;
mod robot_model;

pub(crate) use collision_models::CollisionModels;
pub(crate) use finger_shape::FingerShape;
pub(crate) use grip_table::{GripGoal, GripTable};
pub(crate) use part_grip::PartGrip;
pub(crate) use robot_model::RobotModel;
