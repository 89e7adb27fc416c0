//! The program as a user runs it.
#![allow(clippy::unwrap_used)]

use std::process::{Command, Output};

/// Runs `coact` with these arguments, to its end.
pub fn coact(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_coact")).args(arguments).output().unwrap()
}
