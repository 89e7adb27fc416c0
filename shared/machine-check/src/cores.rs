//! The cores, and what else runs on them.

use crate::root::{Root, contains, mask_contains};
use crate::{Finding, Level};
use std::io::Read;

/// A core that takes longer to wake up delays a cycle by a tenth of the period, µs.
const SLOW_WAKE_UP_US: u64 = 100;

pub(crate) fn number(root: &Root<'_>) -> Finding {
    let table = root.text("/proc/cpuinfo").unwrap_or_default();
    let cores = table.lines().filter(|line| line.starts_with("processor")).count();
    Finding::new(
        "cores",
        if cores >= 2 { Level::Green } else { Level::Red },
        cores.to_string(),
        "at least 2: one for the chain, one for everything else",
        "use a machine with more cores, or give this one more",
    )
}

/// Of the chain's cores.
pub(crate) fn governor(root: &Root<'_>, cores: &[usize]) -> Finding {
    let of = |core| root.text(&format!("/sys/devices/system/cpu/cpu{core}/cpufreq/scaling_governor"));
    let unsteady =
        cores.iter().find_map(|&core| Some((core, of(core)?)).filter(|(_, name)| name != "performance"));
    let steady = cores.iter().find_map(|&core| of(core)).unwrap_or_else(|| "none".into());
    let (level, found) = match unsteady {
        None => (Level::Green, steady),
        Some((core, name)) => (Level::Yellow, format!("{name} on core {core}")),
    };
    Finding::new(
        "governor",
        level,
        found,
        "performance, or none",
        "sudo cpupower frequency-set --governor performance",
    )
}

/// How long the chain's cores may take to wake up: as their idle states say, and what is held of them in `/dev/cpu_dma_latency`.
pub(crate) fn idle_states(root: &Root<'_>, cores: &[usize]) -> Finding {
    let slowest = cores.iter().map(|&core| slowest_wake_up(root, core)).max().unwrap_or(0);
    let held = held_latency(root).filter(|held| *held < slowest);
    let takes = held.unwrap_or(slowest);
    let (level, found) = match (takes <= SLOW_WAKE_UP_US, held) {
        (true, None) => (Level::Green, format!("a core wakes up within {takes} µs")),
        (true, Some(_)) => (Level::Green, format!("/dev/cpu_dma_latency is held at {takes} µs")),
        (false, _) => (Level::Yellow, format!("a core may take {takes} µs to wake up")),
    };
    Finding::new(
        "idle states",
        level,
        found,
        "100 µs at most",
        "add processor.max_cstate=1 to the kernel's command line, or keep /dev/cpu_dma_latency open with 0 written to it",
    )
}

/// Of the idle states that are not disabled, µs.
fn slowest_wake_up(root: &Root<'_>, core: usize) -> u64 {
    let states = format!("/sys/devices/system/cpu/cpu{core}/cpuidle");
    let number = |state: &str, file: &str| -> Option<u64> {
        root.text(&format!("{states}/{state}/{file}"))?.parse().ok()
    };
    let names = root.names(&states);
    let enabled = names.iter().filter(|state| number(state, "disable").unwrap_or(0) == 0);
    enabled.filter_map(|state| number(state, "latency")).max().unwrap_or(0)
}

/// What somebody keeps the wake-up latency of all cores below, µs: the device tells it as four bytes.
fn held_latency(root: &Root<'_>) -> Option<u64> {
    let mut bytes = [0; 4];
    let mut device = std::fs::File::open(root.path("/dev/cpu_dma_latency")).ok()?;
    device.read_exact(&mut bytes).ok()?;
    u64::try_from(i32::from_ne_bytes(bytes)).ok()
}

/// Whether a core of the chain is left alone by the scheduler, by interrupts and by the kernel's workers.
pub(crate) fn isolation(root: &Root<'_>, core: usize) -> [Finding; 3] {
    let isolated = root.text("/sys/devices/system/cpu/isolated").unwrap_or_default();
    let alone = contains(&isolated, core);
    let interrupts = interrupts_on(root, core);
    let state = if alone { "isolated" } else { "not isolated" };
    [
        Finding::new(
            "isolation",
            if alone { Level::Green } else { Level::Yellow },
            format!("core {core} of the chain is {state}"),
            "isolated",
            "see rt-config/system/README.md, step 4; needed only where cycles are late otherwise",
        ),
        Finding::new(
            "interrupts",
            if interrupts == 0 { Level::Green } else { Level::Yellow },
            format!("{interrupts} interrupts of devices may arrive on core {core}"),
            "none on the chain's core",
            "add irqaffinity= with the other cores to the kernel's command line, or write them to /proc/irq/*/smp_affinity_list",
        ),
        kernel_workers(root, core),
    ]
}

/// Workers that belong to no core do what others asked of the kernel, as to write files back to a disk. Without full preemption one keeps
/// its core for a millisecond and more.
fn kernel_workers(root: &Root<'_>, core: usize) -> Finding {
    let allowed = root.text("/sys/devices/virtual/workqueue/cpumask").unwrap_or_default();
    let come = mask_contains(&allowed, core);
    Finding::new(
        "kernel workers",
        if come { Level::Yellow } else { Level::Green },
        format!("those that belong to no core {} on core {core}", if come { "may run" } else { "never run" }),
        "none on the chain's core",
        "write the mask of the other cores to /sys/devices/virtual/workqueue/cpumask (rt-config/system/README.md, step 2)",
    )
}

fn interrupts_on(root: &Root<'_>, core: usize) -> usize {
    let lists = root.names("/proc/irq").into_iter().filter_map(|number| {
        root.text(&format!("/proc/irq/{number}/effective_affinity_list"))
            .filter(|list| !list.is_empty())
            .or_else(|| root.text(&format!("/proc/irq/{number}/smp_affinity_list")))
    });
    lists.filter(|list| contains(list, core)).count()
}
