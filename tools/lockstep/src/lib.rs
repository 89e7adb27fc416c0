//! The stages of all processes in one, a tick at a time, as fast as the machine allows.
//!
//! [`Lockstep`] holds the same stages that the processes run, and one message of each topic; a tick hands each
//! message on to the next stage. Given the same inputs it computes the bits that the process set computes: there is
//! no clock in it, and a message's stamps are the tick's own time. [`run`] adds monitor, voice and a run's report.
//!
//! ```
//! use coact_lockstep::Lockstep;
//! use coact_pipeline::{RunSettings, WorldMode};
//!
//! # let rt_config = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
//! let shipped = RunSettings::shipped(&rt_config);
//! let mut stages = Lockstep::new(&RunSettings { world: WorldMode::Kinematic, ..shipped })?;
//! for _ in 0..100 {
//!     stages.step();
//! }
//! assert_eq!(stages.command.header.cycle, 99);
//! assert!(!stages.complete(), "a vehicle is not built in a tenth of a second");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod lockstep;
mod run;

pub use lockstep::{Lockstep, LockstepError};
pub use run::{FinishedRun, RunError, run};
