//! Which processes make up a running set, and where one run of them keeps its files.
//!
//! [`Pipeline`] is the process table of `rt-config/pipeline.toml`. [`Run`] is one run's directory: identity, inputs,
//! readiness of each process, and the shared-memory prefix that keeps two runs beside each other apart.
//!
//! ```
//! use coact_pipeline::{Pipeline, Trigger};
//!
//! let text = r#"
//!     [[process]]
//!     name = "world"
//!     program = "coact-world"
//!     order = 1
//!     trigger = "timer"
//! "#;
//! let pipeline = Pipeline::parse(text, "pipeline.toml".as_ref())?;
//! assert_eq!(pipeline.period_ns(), 1_000_000);
//! assert_eq!(pipeline.process("world")?.trigger, Trigger::Timer);
//! # Ok::<(), coact_pipeline::PipelineError>(())
//! ```

mod pipeline;
mod pipeline_error;
mod pipeline_file;
mod process_entry;
mod ready;
mod restart_policy;
mod run;
mod run_error;
mod run_settings;
mod shared_memory;

pub use pipeline::Pipeline;
pub use pipeline_error::PipelineError;
pub use process_entry::{ProcessEntry, Trigger};
pub use ready::{GENERATION_VARIABLE, Ready};
pub use restart_policy::RestartPolicy;
pub use run::Run;
pub use run_error::RunError;
pub use run_settings::{RunSettings, WorldMode};
