//! Limits of the group of processes that this one belongs to, and of those above it (control groups, version 2).

use crate::root::Root;
use crate::{Finding, Level};

/// Memory of a process set, locked, with as much in reserve, MiB.
const PLENTY: u64 = 1024;

pub(crate) fn processor(root: &Root<'_>) -> Finding {
    let cores = |text: String| -> Option<f64> {
        let (quota, period) = text.split_once(' ')?;
        Some(quota.parse::<f64>().ok()? / period.parse::<f64>().ok()?)
    };
    let least = values(root, "cpu.max").into_iter().filter_map(cores).reduce(f64::min);
    let (level, found) = match least {
        None => (Level::Green, "no limit".to_owned()),
        Some(cores) if cores >= 2.0 => (Level::Yellow, format!("{cores:.1} cores")),
        Some(cores) => (Level::Red, format!("{cores:.1} cores")),
    };
    Finding::new(
        "cgroup processor",
        level,
        found,
        "no limit: one that is used up stops processes for milliseconds",
        "remove the limit (docker: without --cpus; systemd: CPUQuota=), and pin to cores instead",
    )
}

pub(crate) fn memory(root: &Root<'_>) -> Finding {
    let mebibytes = |text: String| text.parse::<u64>().ok().map(|bytes| bytes >> 20);
    let least = values(root, "memory.max").into_iter().filter_map(mebibytes).min();
    let (level, found) = match least {
        None => (Level::Green, "no limit".to_owned()),
        Some(size) if size >= PLENTY => (Level::Green, format!("{size} MiB")),
        Some(size) => (Level::Red, format!("{size} MiB")),
    };
    Finding::new(
        "cgroup memory",
        level,
        found,
        "at least 1024 MiB: shared memory counts, too",
        "raise the limit (docker: --memory; systemd: MemoryMax=)",
    )
}

/// The contents of a file of this group and of all above it.
fn values(root: &Root<'_>, file: &str) -> Vec<String> {
    let table = root.text("/proc/self/cgroup").unwrap_or_default();
    let Some(group) = table.lines().find_map(|line| line.strip_prefix("0::")) else { return Vec::new() };
    let folders = std::path::Path::new(group).ancestors();
    folders.filter_map(|folder| root.text(&format!("/sys/fs/cgroup{}/{file}", folder.display()))).collect()
}
