//! The stages of all processes in one, a tick at a time, as fast as the machine allows.
//!
//! [`Lockstep`] holds the same stages that the processes run, and one message of each topic; a tick hands each
//! message on to the next stage. Given the same inputs it computes the bits that the process set computes: there is
//! no clock in it, and a message's stamps are the tick's own time. [`run`] adds the judgement of a run's report.

mod lockstep;
mod run;

pub use lockstep::{Lockstep, LockstepError};
pub use run::{FinishedRun, RunError, run};
