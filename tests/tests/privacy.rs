//! Nobody else gets at a running set, however carelessly it was started.
#![allow(clippy::unwrap_used)]

use coact_pipeline::Run;
use coact_tests::{Launched, alone, coact};
use std::collections::BTreeSet;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Everything in a folder, and below it.
fn below(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let inside = entries.flat_map(|entry| {
        let path = entry.path();
        let deeper = if path.is_dir() { below(&path) } else { Vec::new() };
        std::iter::once(path).chain(deeper)
    });
    inside.collect()
}

/// What is open to others of these.
fn open(paths: impl IntoIterator<Item = PathBuf>) -> Vec<(PathBuf, u32)> {
    let modes = paths.into_iter().filter_map(|path| Some((path.symlink_metadata().ok()?.mode(), path)));
    modes.filter(|(mode, _)| mode & 0o077 != 0).map(|(mode, path)| (path, mode & 0o777)).collect()
}

/// Inodes of the sockets that a process has.
fn sockets(pid: u32) -> BTreeSet<String> {
    let files = std::fs::read_dir(format!("/proc/{pid}/fd")).into_iter().flatten().flatten();
    let links = files.filter_map(|file| std::fs::read_link(file.path()).ok());
    let inode = |link: PathBuf| {
        let name = link.to_string_lossy().into_owned();
        Some(name.strip_prefix("socket:[")?.strip_suffix(']')?.to_owned())
    };
    links.filter_map(inode).collect()
}

/// Inodes of all sockets of the network.
fn network() -> BTreeSet<String> {
    let tables = ["tcp", "tcp6", "udp", "udp6", "raw", "raw6"].map(|name| format!("/proc/net/{name}"));
    let texts = tables.into_iter().filter_map(|table| std::fs::read_to_string(table).ok());
    texts.flat_map(|text| inodes(&text)).collect()
}

fn inodes(table: &str) -> Vec<String> {
    let inode = |line: &str| line.split_ascii_whitespace().nth(9).map(str::to_owned);
    table.lines().skip(1).filter_map(inode).collect()
}

fn processes(run: &Run) -> Vec<u32> {
    let names = ["world", "perception", "fields", "control", "monitor", "voice"];
    names.map(|name| run.ready(name, 0).unwrap().unwrap().pid).into()
}

#[test]
fn a_set_that_was_started_with_the_umask_000_is_closed_to_others_and_has_no_network_port() {
    let _alone = alone();
    let mut command = Command::new("sh");
    command.args(["-c", "umask 000; exec \"$0\" \"$@\""]).arg(coact());
    let mut launched = Launched::start_by(command, &["--duration", "6", "--world", "kinematic"]);
    let (run, report) = (launched.when_started(), launched.report());
    let prefix = run.prefix();
    let of_run = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().starts_with(&prefix);
    let memory: Vec<_> = std::fs::read_dir("/dev/shm").unwrap().map(|entry| entry.unwrap().path()).collect();
    let memory: Vec<_> = memory.into_iter().filter(of_run).collect();
    assert!(memory.len() > 20, "{memory:?}");
    // What lies below a folder that nobody else can enter is closed as well.
    let in_run = std::fs::read_dir(run.directory()).unwrap().map(|entry| entry.unwrap().path());
    assert_eq!(open(memory.into_iter().chain(in_run).chain([run.directory().to_owned()])), []);
    let network = network();
    for pid in processes(&run) {
        let ports: Vec<_> = sockets(pid).intersection(&network).cloned().collect();
        assert_eq!(ports, Vec::<String>::new(), "process {pid}");
    }
    let kept = launched.folder();
    launched.finish();
    assert_eq!(open([report.clone()].into_iter().chain(below(&report))), []);
    drop(kept);
}
