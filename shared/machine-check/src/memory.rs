//! Memory that is swapped, and memory that is shared.

use crate::root::Root;
use crate::{Finding, Level};

/// What a process set with its replacements takes of shared memory, with as much in reserve, MiB.
const PLENTY: u64 = 512;
/// What it takes without.
const LEAST: u64 = 128;

pub(crate) fn swap(root: &Root<'_>) -> Finding {
    let areas = root.text("/proc/swaps").map_or(0, |table| table.lines().skip(1).count());
    let swappiness =
        root.text("/proc/sys/vm/swappiness").and_then(|text| text.parse::<u32>().ok()).unwrap_or(60);
    let calm = areas == 0 || swappiness <= 10;
    Finding::new(
        "swap",
        if calm { Level::Green } else { Level::Yellow },
        format!("{areas} areas, swappiness {swappiness}"),
        "none, or a swappiness of 10 at most: what is not locked may be swapped out",
        "install rt-config/system/sysctl.d/coact.conf",
    )
}

pub(crate) fn shared(root: &Root<'_>) -> Finding {
    let free =
        rustix::fs::statvfs(root.path("/dev/shm")).map(|found| (found.f_bavail * found.f_frsize) >> 20);
    let (level, found) = match free {
        Ok(free) if free >= PLENTY => (Level::Green, format!("{free} MiB free")),
        Ok(free) if free >= LEAST => (Level::Yellow, format!("{free} MiB free")),
        Ok(free) => (Level::Red, format!("{free} MiB free")),
        Err(error) => (Level::Red, format!("not there: {error}")),
    };
    Finding::new(
        "shared memory",
        level,
        found,
        "512 MiB free in /dev/shm",
        "remove what lies in /dev/shm, or enlarge it: mount -o remount,size=2G /dev/shm (docker: --shm-size=2g)",
    )
}
