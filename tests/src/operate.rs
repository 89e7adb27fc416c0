use crate::coact;
use std::process::{Command, Stdio};

/// Runs `coact COMMAND` to its end; its exit status, what it said, and its process id. Always with the name of a run, or with
/// several runs of one's own: without, it would stop whatever else runs on this machine.
///
/// # Panics
/// The program cannot be run.
pub fn operate(arguments: &[&str]) -> (Option<i32>, String, u32) {
    let mut command = Command::new(coact());
    command.args(arguments).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    let child = command.spawn().unwrap();
    let pid = child.id();
    let output = child.wait_with_output().unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap(), pid)
}
