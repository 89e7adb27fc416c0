//! Which processes make up a set, and where one run of them keeps its files.
//!
//! [`Pipeline`] is the process table of `rt-config/pipeline.toml`. [`Run`] is one run's directory: identity, inputs,
//! readiness of each process, and the shared-memory prefix that keeps two runs beside each other apart.
//!
//! ```
//! use coact_pipeline::{Pipeline, Trigger};
//! use std::time::Duration;
//!
//! let text = r#"
//!     [[process]]
//!     name = "world"
//!     program = "coact-world"
//!     order = 1
//!     trigger = "timer"
//!     [[process]]
//!     name = "perception"
//!     program = "coact-perception"
//!     order = 1
//!     trigger = "coact/sensors"
//!     latest_start_us = 550
//! "#;
//! let pipeline = Pipeline::parse(text, "pipeline.toml".as_ref())?;
//! assert_eq!(pipeline.process("world")?.trigger, Trigger::Timer);
//! assert_eq!(pipeline.process("perception")?.latest_start, Duration::from_micros(550));
//! assert_eq!(pipeline.restart.intensity, 5, "the default");
//! // A mistake is refused with its place, and with what was expected there.
//! let refused = Pipeline::parse("period_us = 500", "pipeline.toml".as_ref());
//! assert!(refused.is_err_and(|error| error.to_string().starts_with("pipeline.toml:1: period_us")));
//! # Ok::<(), coact_pipeline::PipelineError>(())
//! ```

mod layout;
mod membership;
mod memory_reserve;
mod movement;
mod owner;
mod pipeline;
mod pipeline_error;
mod pipeline_file;
mod process_entry;
mod process_stat;
mod ready;
mod restart_policy;
mod run;
mod run_error;
mod run_lock;
mod run_settings;
mod shared_memory;
mod trust;

pub use layout::Layout;
pub use membership::Membership;
pub use memory_reserve::MemoryReserve;
pub use movement::Movement;
pub use owner::Owner;
pub use pipeline::Pipeline;
pub use pipeline_error::PipelineError;
pub use process_entry::{ProcessEntry, Trigger};
pub use process_stat::ProcessStat;
pub use ready::{GENERATION_VARIABLE, Ready};
pub use restart_policy::RestartPolicy;
pub use run::Run;
pub use run_error::RunError;
pub use run_settings::{RunSettings, WorldMode};
