//! Robots from their files: kinematics, hands, grips.

mod grips;
mod kinematics;
mod loading;
