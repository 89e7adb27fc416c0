//! Control: decisions become movements. A pure stage, [`Control`], that turns the field frame's decision into joint
//! setpoints at 1 kHz.
//!
//! A decision names one of the task's actions; the action's motor skill becomes an *errand* (take a part, place it,
//! hold out the hand, steady the base ...), an errand a row of *legs* (plan, reach, approach, close, lift ...), a leg a
//! minimum-jerk movement of all joints. Postures come from a search over the closed-form inverse kinematics that is
//! spread over some twenty cycles, while the movement under way goes on. A changed decision bends the movement under
//! way into the next one; only closing, lifting, opening and retreating are finished first.
//!
//! Behind all that stands one limiter for each joint, which lets no setpoint pass from which the joint could not be
//! stopped within its limits. When the sensor sample or the field frame is older than [`Settings::stale_after`], all
//! joints brake and stand; the errand goes on when fresh messages come.
//!
//! Everything that must outlive the process stands in [`Command`](coact_messages::Command): the setpoints, and in its
//! `memory` the words of the private struct `Memory`, in the order of its fields.
//!
//! ```no_run
//! # fn messages() -> (coact_messages::SensorSample, coact_messages::FieldFrame) { todo!() }
//! use coact_control::{Control, Settings};
//! use coact_joint_task::Task;
//! use coact_messages::Command;
//! use coact_robot::Robot;
//!
//! let robot = Robot::load("rt-config/robots/aros.toml".as_ref())?;
//! let task = Task::load("rt-config/tasks/toy-vehicle.toml".as_ref())?;
//! let mut control = Control::new(robot, &task, Settings::default())?;
//! let mut command: Box<Command> = bytemuck::zeroed_box();
//! let (sample, frame) = messages();
//! control.step(0, Some(&sample), None, Some(&frame), None, &mut command);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod body;
mod choice;
mod control;
mod control_error;
mod errand;
mod memory;
mod places;
mod pursue;
mod senses;
mod servo;
mod settings;

pub use control::Control;
pub use control_error::ControlError;
pub use settings::Settings;

use memory::Memory;
