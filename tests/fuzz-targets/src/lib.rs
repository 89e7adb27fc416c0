//! Every reader of what this program did not write itself, as a function of bytes: files, requests, messages, states.
//!
//! A [`Target`] takes any bytes, and must neither panic, nor hang, nor take much memory; what it takes in must be used without
//! any of that, too. [`TARGETS`] has them all, each with its seeds: files that the project ships, and those of the folder
//! `corpus`, where bytes that broke a target once are kept. [`exercise`] changes seeds at random and judges what happens:
//! the test of this crate does so for some seconds with each target, `COACT_FUZZ_SECONDS` for longer. The folder `fuzz` wraps
//! the same targets for `cargo fuzz`, which finds more.
//!
//! ```
//! use coact_fuzz_targets::{Bounds, exercise, find};
//!
//! let target = find("safety-limits").ok_or("no such target")?;
//! assert!(!(target.run)(b"protective_separation_m = nan"), "refused, and nothing else");
//! let seen = exercise(target, &Bounds { seconds: 0.1, ..Bounds::default() })?;
//! assert!(seen.inputs > 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![allow(clippy::unwrap_used, reason = "a library of tests: what fails, fails the test")]

mod assembly;
mod bounds;
mod configuration;
mod exercise;
mod failure;
mod messages;
mod mutator;
mod patch;
mod records;
mod requests;
mod robots;
mod run_recordings;
mod scratch;
mod seeds;
mod states;
mod table;
mod target;
mod watch;

pub use bounds::Bounds;
pub use exercise::{Exercised, exercise};
pub use failure::Failure;
pub use seeds::{Seed, checkout, seeds};
pub use table::{TARGETS, find, run};
pub use target::{Input, Target};
