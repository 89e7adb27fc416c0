//! The last word before the joints.
//!
//! Control asks for setpoints; the side that drives the joints answers for them. [`Drive`] judges every command before it is
//! followed (layout, numbers, sequence, age, and whether the joints can do it within their limits from where they are), takes one
//! step in each cycle whatever arrives, and brakes by itself when good commands stop. So the limits of position, velocity,
//! acceleration and jerk hold for time, not for each command.
//!
//! ```text
//! no good command for      1..2 cycles   3 cycles and more      told to hold
//! the joints               go on         brake, then stand      brake, then stand; commands are counted, not followed
//! ```
//!
//! A drive reads no clock and does no I/O. Today the simulated world steps one in each cycle; the driver of a real arm will.
//!
//! ```
//! use bytemuck::Zeroable;
//! use coact_drive::Drive;
//! use coact_messages::{Command, DriveMode, HoldReason, JOINTS, LAYOUT};
//! use coact_robot::JointLimits;
//! use coact_safety::SafetyLimits;
//!
//! let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config/safety.toml");
//! let safety = SafetyLimits::load(file.as_ref())?;
//! let joint = JointLimits { lower: -1.0, upper: 1.0, velocity: 2.0, effort: 1.0, acceleration: 10.0, jerk: 200.0 };
//! let mut drive = Drive::new([joint; JOINTS], safety.drive);
//! drive.start(0, &[0.5; JOINTS]);
//!
//! // What the joints can do is followed ...
//! let mut command = Command::zeroed();
//! command.header.layout = LAYOUT;
//! command.position = [0.5 + 1e-7; JOINTS];
//! drive.step(1, Some(&command), HoldReason::None, &[0.5; JOINTS]);
//! assert_eq!(drive.report().mode, DriveMode::Following as u32);
//!
//! // ... and what they cannot do is not.
//! (command.header.cycle, command.header.sequence) = (1, 1);
//! command.position = [0.9; JOINTS];
//! drive.step(2, Some(&command), HoldReason::None, &[0.5; JOINTS]);
//! assert!(drive.report().position[0] < 0.501);
//! assert_eq!(drive.report().refused.iter().sum::<u64>(), 1);
//! # Ok::<(), coact_safety::SafetyError>(())
//! ```

mod drive;
mod drive_state;
mod followed_command;
mod followed_path;
mod joint_limits;

pub use drive::Drive;
pub use drive_state::DriveState;
pub use joint_limits::{FASTEST_SETPOINT, joint_limits};
