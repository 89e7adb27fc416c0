//! A robot arm with a hand: its URDF, kinematics, grips and limits. The crate knows no task, no message and no clock.
//!
//! # Joints
//! [`ROBOT_JOINTS`] = 14 angles in the order of the messages: arm 1..7, hand spread, three finger bases, three finger
//! tips (the messages' fifteenth is reserved). All lengths in m, angles in rad, poses in the world frame, z up.
//!
//! # Palm and grasp point
//! The palm frame has its origin in the palm, z out of the palm (the *approach axis*) and x from finger 3 towards
//! fingers 1 and 2 (the *closing axis*). [`Robot::palm`] gives its pose. The *grasp point* lies on the palm's z axis,
//! [`Hand::grasp_distance`] in front of it: there the finger ends meet. [`Robot::grasp_point`] gives its place.
//!
//! A part's frame is at the centre of its underside, z up. It is gripped [`grip_height`] above its underside, so a part is
//! between the fingers when the grasp point lies near `frame * (0, 0, grip_height(height))`.
//!
//! # Grips
//! [`Grips`] lists the grips with which the hand can take a [`Graspable`]: by the finger ends or with the whole hand, from
//! above or from the side, as far as the hand's kinematics and the part's [`NextUse`] allow them.
//!
//! # Fingers
//! Base angle 0 is a flat open hand; tips follow by [`Hand::coupling`] (1/3). [`Hand::base_for_width`] is the base
//! angle at which the finger ends touch something of that width (25 mm: 1.59 rad; 55 mm: 1.48; 75 mm: 1.40);
//! [`Hand::width`] is the clear width at a base angle. A hand whose width is at most the part's width has closed on it.
//!
//! # Movements
//! [`Quintic`] is the minimum-jerk movement of one joint, [`PointToPoint`] that of several, which start and stop together.
//! A trajectory of the arm is a row of [`Knot`]s joined by quintics; [`state_at`] an instant it has a state.
//! The [`Limiter`] stands before the servo: whatever setpoints it is given, it keeps a joint's limits. Movements around
//! obstacles are planned by the crate `coact-motion`.
//!
//! # Example
//! ```
//! use coact_robot::{GripKind, Graspable, Grips, NextUse, Robot};
//!
//! let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config/robots/aros.toml");
//! let robot = Robot::load(file.as_ref())?;
//!
//! // Forward kinematics; and inverse: the postures that have this palm pose, with the elbow at a swivel angle of 0.3 rad.
//! let palm = robot.palm(&robot.park);
//! println!("parked, the palm is at {}", palm.translation.vector.transpose());
//! for posture in robot.kinematics.solve(&palm, 0.3, 0.0).as_slice() {
//!     assert!((robot.palm(posture).translation.vector - palm.translation.vector).norm() < 1e-9);
//! }
//!
//! // A column of 55 mm can be gripped with the whole hand, a nut cannot.
//! let kinds = |object| Grips::of(&robot.hand, object, NextUse::Anything).all.into_iter().map(|grip| grip.kind);
//! assert!(kinds(Graspable::round(0.055, 0.12)).any(|kind| kind == GripKind::WholeHand));
//! assert!(kinds(Graspable::round(0.025, 0.02)).all(|kind| kind == GripKind::Precision));
//! # Ok::<(), coact_robot::RobotError>(())
//! ```

mod arm;
mod arm_end;
mod config;
mod error;
mod finger_closure;
mod graspable;
mod grip;
mod grip_frame;
mod grip_kind;
mod grip_side;
mod grips;
mod hand;
mod hand_goal;
mod joint;
mod knot;
mod limiter;
mod mounting;
mod next_use;
mod path_progress;
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
pub use grip::Grip;
pub use grip_frame::{grip_frame, grip_height};
pub use grip_kind::GripKind;
pub use grip_side::GripSide;
pub use grips::Grips;
pub use hand::{Finger, Grasp, HAND_JOINTS, Hand};
pub use hand_goal::HandGoal;
pub use joint::{Joint, JointLimits};
pub use knot::{Knot, jerk_at, state_at};
pub use limiter::{Limiter, towards_zero};
pub use next_use::NextUse;
pub use path_progress::PathProgress;
pub use point_to_point::PointToPoint;
pub use quintic::{MotionState, Quintic};
pub use robot::{ROBOT_JOINTS, Robot};
pub use srs::{Branches, NotSrs, Posture, Srs};
pub use urdf::{Urdf, isometry};
