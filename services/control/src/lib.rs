//! Control: decisions become movements. A pure stage, [`Control`], that turns the field frame's decision into joint
//! setpoints at 1 kHz.
//!
//! A decision names one of the task's actions; a *skill* serves it (pick a part, insert it, hold out the hand, steady the
//! base ...), and a skill is a row of *phases* (plan, move, close, verify ...). A movement is planned by `coact_motion`,
//! beside the servo in real time ([`Control::in_real_time`]), at once in lockstep ([`Control::new`]): out of where the hand
//! is, to the goal, and straight into it, as one. A changed decision, a part that moves and a person in the way are answered
//! in motion: the next movement begins in the very state for which it was planned. Only closing and opening the fingers are
//! finished first.
//!
//! A guard looks at the next moments of the trajectory and slows it down, to standing if need be, where the person's arm
//! comes near. Behind all that stands one limiter for each joint, which lets no setpoint pass from which the joint could
//! not be stopped within its limits. When the sensor sample or the field frame is stale, all joints brake and stand; the
//! skill goes on when fresh messages come. Distances and times that keep the person safe come from
//! [`SafetyLimits`](coact_safety::SafetyLimits).
//!
//! Everything that must outlive the process stands in [`Command`](coact_messages::Command): the setpoints, and in its
//! `state` the private struct `ControlState`, in the words of `coact_stage_state`.
//!
//! ```no_run
//! # fn messages() -> (Box<coact_messages::SensorSample>, Box<coact_messages::FieldFrame>) {
//! #     (bytemuck::zeroed_box(), bytemuck::zeroed_box())
//! # }
//! use coact_control::Control;
//! use coact_joint_task::Task;
//! use coact_messages::Command;
//! use coact_robot::Robot;
//! use coact_safety::SafetyLimits;
//!
//! let robot = Robot::load("rt-config/robots/aros.toml".as_ref())?;
//! let task = Task::load("rt-config/tasks/toy-vehicle.toml".as_ref())?;
//! let limits = SafetyLimits::load("rt-config/safety.toml".as_ref())?;
//! let mut control = Control::new(robot, &task, &limits)?;
//! let mut command: Box<Command> = bytemuck::zeroed_box();
//! let (sample, frame) = messages();
//! control.step(0, Some(&sample), None, Some(&frame), None, &mut command);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod braking_path;
mod control;
mod control_error;
mod decide;
mod guard;
mod inputs;
mod movements;
mod moving_fingers;
mod person;
mod planning;
mod pursue;
mod reachability;
mod resynchronise;
mod robot;
mod servo;
mod skill_choice;
mod state;
mod verify;

pub use control::Control;
pub use control_error::ControlError;
pub use planning::{PlannerDelay, PlanningThread, UnknownDelay};
