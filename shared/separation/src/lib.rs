//! How near robot and person really came: measured in each tick against the truth, never against what perception makes of it.
//!
//! [`SeparationMeter`] holds the robot's true posture against the person's true arm. It shares the forms of the robot's links
//! with the planner, and nothing with perception or with the guard that it judges.
//!
//! ```
//! use coact_messages::{Command, Truth};
//! use coact_robot::Robot;
//! use coact_safety::SafetyLimits;
//! use coact_separation::SeparationMeter;
//!
//! let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config");
//! let robot = Robot::load(format!("{folder}/robots/aros.toml").as_ref())?;
//! let limits = SafetyLimits::load(format!("{folder}/safety.toml").as_ref())?;
//! let mut meter = SeparationMeter::new(&robot, &limits)?;
//! let (truth, command): (Box<Truth>, Box<Command>) = (bytemuck::zeroed_box(), bytemuck::zeroed_box());
//! meter.tick(&truth, &command);
//! assert_eq!(meter.report().nearest_m, None, "nobody is there");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod needed_separation;
mod separation_meter;

pub use separation_meter::SeparationMeter;
