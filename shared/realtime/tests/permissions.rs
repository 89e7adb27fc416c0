//! Nothing of a run can be opened by another user, even if the process was given the umask 000.
#![allow(clippy::unwrap_used)]

mod support;

use coact_messages::{FieldFrame, Percept, topic};
use coact_pipeline::Pipeline;
use coact_realtime::{Bus, TopicAnchors};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use support::{TABLE, TestRun};

fn entries(path: &Path) -> impl Iterator<Item = PathBuf> {
    std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path())
}

// The only test of this file: the umask belongs to the whole process.
#[test]
fn every_file_socket_and_segment_of_a_run_is_closed_to_others_whatever_the_umask() {
    rustix::process::umask(rustix::fs::Mode::empty());
    let run = TestRun::new(TABLE);
    let pipeline = Pipeline::load(&run.0.settings().pipeline).unwrap();
    let bus = Bus::open(&run.0, "fields", 0).unwrap();
    let _anchors = TopicAnchors::new(&bus, &pipeline).unwrap();
    let _trigger = bus.trigger::<Percept>(topic::PERCEPT).unwrap();
    let mut output = bus.output::<FieldFrame>(topic::FIELDS).unwrap();
    output.loan().unwrap().send(1, 2).unwrap();
    let prefix = run.0.prefix();
    let is_of_run = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().starts_with(&prefix);
    let mut all: Vec<_> = entries("/dev/shm".as_ref()).filter(is_of_run).collect();
    assert!(all.len() > 10, "{all:?}");
    // What iceoryx2 makes below `iox` is behind this directory, which nobody else can enter.
    all.push(run.0.directory().to_owned());
    all.extend(entries(run.0.directory()));
    let open: Vec<_> = all
        .iter()
        .map(|path| (path, path.symlink_metadata().unwrap().mode()))
        .filter(|(_, mode)| mode & 0o077 != 0)
        .collect();
    assert!(open.is_empty(), "open to others: {open:?}");
}
