//! Distances, speeds and times that keep the person safe.
//!
//! They stand in one commented file, `rt-config/safety.toml`, and are checked when they are read: a key that is missing,
//! unknown or out of its range is refused with its line. Guard, planner and perception take them from [`SafetyLimits`]; no
//! other place holds such a number.
//!
//! ```
//! use coact_safety::SafetyLimits;
//!
//! let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config/safety.toml");
//! let limits = SafetyLimits::load(file.as_ref())?;
//! assert!(limits.person.acceleration(false, 0.5) > limits.person.acceleration(true, 0.0));
//! # Ok::<(), coact_safety::SafetyError>(())
//! ```

mod comfort;
mod range;
mod safety_error;
mod safety_file;
mod safety_limits;

pub use comfort::Comfort;
pub use safety_error::SafetyError;
pub use safety_limits::{DriveLimits, GuardLimits, PersonLimits, PlannerLimits, SafetyLimits, StaleLimits};
