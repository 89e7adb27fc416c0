//! The robot's body: URDF, kinematics, grips and trajectories. It knows no task, no message and no clock.
//!
//! # Joints
//! [`ROBOT_JOINTS`] = 14 angles in the order of the messages: arm 1..7, hand spread, three finger bases, three finger
//! tips (the messages' fifteenth is reserved). All lengths m, angles rad, poses in the world frame, z up.
//!
//! # Palm and grasp point
//! The palm frame has its origin in the palm, z out of the palm (the *approach axis*) and x from finger 3 towards
//! fingers 1 and 2 (the *closing axis*). [`Robot::palm`] gives its pose. The *grasp point* lies on the palm's z axis,
//! [`Hand::grasp_distance`] in front of it: there the finger ends meet. [`Robot::grasp_point`] gives its place.
//!
//! A part's frame is at the centre of its underside, z up. It is gripped [`grip::grip_height`] above its underside,
//! so a part is between the fingers when the grasp point lies near `frame * (0, 0, grip_height(height))`.
//!
//! # Grips
//! [`Grips`] lists the ways in which the hand can take a [`Graspable`]: by the finger ends or with the whole hand, from above
//! or from the side, as far as the hand's kinematics allow them and what is done next with it.
//!
//! # Fingers
//! Base angle 0 is a flat open hand; tips follow by [`Hand::coupling`] (1/3). [`Hand::base_for_width`] is the base
//! angle at which the finger ends touch something of that width (25 mm: 1.59 rad; 55 mm: 1.48; 75 mm: 1.40);
//! [`Hand::width`] is the clear width at a base angle. A hand whose width is at most the part's width has closed on it.
//!
//! ```no_run
//! use coact_robot::Robot;
//!
//! let robot = Robot::load("rt-config/robots/aros.toml".as_ref())?;
//! println!("at rest the hand grasps at {}", robot.grasp_point(&robot.park));
//! # Ok::<(), coact_robot::RobotError>(())
//! ```

mod arm;
mod arm_end;
mod config;
mod error;
mod graspable;
pub mod grip;
mod grips;
mod hand;
mod hand_goal;
mod joint;
mod limiter;
mod mounting;
mod point_to_point;
mod quintic;
mod robot;
mod srs;
mod urdf;
mod xml_line;

pub use arm::Arm;
pub use arm_end::ArmEnd;
pub use error::RobotError;
pub use graspable::{Flat, Graspable};
pub use grips::{Grip, GripKind, GripSide, Grips, NextUse};
pub use hand::{Finger, Grasp, HAND_JOINTS, Hand};
pub use hand_goal::HandGoal;
pub use joint::{Joint, JointLimits};
pub use limiter::Limiter;
pub use point_to_point::PointToPoint;
pub use quintic::{MotionState, Quintic};
pub use robot::{ROBOT_JOINTS, Robot};
pub use srs::{Branches, NotSrs, Posture, Srs};
pub use urdf::{Urdf, isometry};
