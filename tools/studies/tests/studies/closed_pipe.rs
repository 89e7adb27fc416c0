//! A reader that has seen enough ends the program without a word.
#![allow(clippy::unwrap_used)]

use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};

#[test]
fn a_table_whose_reader_has_gone_away_ends_quietly() {
    let task = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
    let mut coact = Command::new(env!("CARGO_BIN_EXE_coact-studies"))
        .args(["task", "show"])
        .arg(task)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The table is longer than a pipe holds: the program is still writing when its reader goes away.
    let mut start = [0; 16];
    coact.stdout.take().unwrap().read_exact(&mut start).unwrap();
    let output = coact.wait_with_output().unwrap();
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
}
