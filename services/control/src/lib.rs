//! Control: decisions become movements. A pure stage, [`Control`], that turns the field frame's decision into joint
//! setpoints at 1 kHz.
//!
//! A decision names one of the task's actions; the action's motor skill becomes an *errand* (take a part, place it,
//! hold out the hand, steady the base ...), an errand a row of *legs* (plan, move, close, feel ...). A movement is planned
//! by `coact_motion`, beside the servo in real time ([`Control::in_real_time`]), at once in lockstep ([`Control::new`]):
//! out of where the hand is, to the goal, and straight into it, as one. A changed decision, a part that moves and a person
//! in the way are answered in motion: the next movement begins in the very state for which it was asked. Only closing and
//! opening the fingers are finished first.
//!
//! A guard looks at the next moments of the movement and slows it down, to standing if need be, where the person's arm
//! comes near. Behind all that stands one limiter for each joint, which lets no setpoint pass from which the joint could
//! not be stopped within its limits. When the sensor sample or the field frame is older than
//! [`Settings::stale_after`], all joints brake and stand; the errand goes on when fresh messages come.
//!
//! Everything that must outlive the process stands in [`Command`](coact_messages::Command): the setpoints, and in its
//! `memory` the words of the private struct `Memory`, in the order of its fields.
//!
//! ```no_run
//! # fn messages() -> (Box<coact_messages::SensorSample>, Box<coact_messages::FieldFrame>) {
//! #     (bytemuck::zeroed_box(), bytemuck::zeroed_box())
//! # }
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

mod answer;
mod ask;
mod body;
mod choice;
mod control;
mod control_error;
mod course;
mod errand;
mod guard;
mod holds;
mod memory;
mod person;
mod places;
mod planner;
mod planning;
mod pursue;
mod request;
mod senses;
mod servo;
mod settings;
mod surroundings;

pub use control::Control;
pub use control_error::ControlError;
pub use planning::PlanningThread;
pub use settings::Settings;

use memory::Memory;
