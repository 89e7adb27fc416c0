//! The program as `coact` starts it.
#![allow(clippy::unwrap_used)]

use std::process::{Command, Output};

/// Runs a study with these arguments, to its end.
pub fn coact(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_coact-studies")).args(arguments).output().unwrap()
}
