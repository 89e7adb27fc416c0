//! What this user's processes may do.

use crate::root::Root;
use crate::{Demand, Finding, Level};

/// Bits of Linux's capabilities.
const CAP_IPC_LOCK: u32 = 14;
const CAP_SYS_NICE: u32 = 23;
/// Files that a process of the set may have to open: those of its ports and of a dead predecessor. Chosen by hand: the usual
/// soft limit, with which sets run.
const OPEN_FILES: u64 = 1024;

pub(crate) fn scheduling(root: &Root<'_>, demand: &Demand) -> Finding {
    let limit = hard_limit(root, "Max realtime priority").unwrap_or(0);
    let may = has(root, CAP_SYS_NICE);
    let found = match may {
        true => "SCHED_FIFO is allowed by privilege".to_owned(),
        false => format!("SCHED_FIFO is allowed up to priority {limit}; {} is asked for", demand.priority),
    };
    let level = if may || limit >= u64::from(demand.priority) { Level::Green } else { Level::Red };
    Finding::new(
        "scheduling",
        level,
        found,
        "SCHED_FIFO up to the highest priority of the process table",
        "install rt-config/system/limits.d/coact.conf, join the group realtime, log in again",
    )
}

pub(crate) fn locked_memory(root: &Root<'_>) -> Finding {
    let limit = hard_limit(root, "Max locked memory");
    let may = has(root, CAP_IPC_LOCK) || limit == Some(u64::MAX);
    let found = match (may, limit) {
        (true, _) => "all memory may be locked".to_owned(),
        (false, Some(bytes)) => format!("at most {} KiB may be locked", bytes / 1024),
        (false, None) => "not readable".to_owned(),
    };
    Finding::new(
        "locked memory",
        if may { Level::Green } else { Level::Red },
        found,
        "unlimited",
        "install rt-config/system/limits.d/coact.conf, join the group realtime, log in again",
    )
}

pub(crate) fn open_files(root: &Root<'_>) -> Finding {
    let limit = hard_limit(root, "Max open files").unwrap_or(0);
    Finding::new(
        "open files",
        if limit >= OPEN_FILES { Level::Green } else { Level::Red },
        format!("at most {limit}"),
        "at least 1024",
        "install rt-config/system/limits.d/coact.conf, or raise it: ulimit -n 16384",
    )
}

/// A limit that the process can raise itself up to; unlimited is the greatest number.
fn hard_limit(root: &Root<'_>, name: &str) -> Option<u64> {
    let table = root.text("/proc/self/limits")?;
    let row = table.lines().find_map(|line| line.strip_prefix(name))?;
    match row.split_whitespace().nth(1)? {
        "unlimited" => Some(u64::MAX),
        number => number.parse().ok(),
    }
}

fn has(root: &Root<'_>, capability: u32) -> bool {
    let status = root.text("/proc/self/status").unwrap_or_default();
    let effective = status.lines().find_map(|line| line.strip_prefix("CapEff:"));
    let bits = effective.and_then(|text| u64::from_str_radix(text.trim(), 16).ok()).unwrap_or(0);
    bits >> capability & 1 == 1
}
