//! The cores, and what else runs on them.

use crate::root::{Root, contains};
use crate::{Finding, Level};

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

pub(crate) fn governor(root: &Root<'_>) -> Finding {
    let found = root.text("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
    let steady = found.as_deref().is_none_or(|governor| governor == "performance");
    Finding::new(
        "governor",
        if steady { Level::Green } else { Level::Yellow },
        found.unwrap_or_else(|| "none".into()),
        "performance, or none",
        "sudo cpupower frequency-set --governor performance",
    )
}

pub(crate) fn idle_states(root: &Root<'_>) -> Finding {
    const STATES: &str = "/sys/devices/system/cpu/cpu0/cpuidle";
    let number = |state: &str, file: &str| -> Option<u64> {
        root.text(&format!("{STATES}/{state}/{file}"))?.parse().ok()
    };
    let names = root.names(STATES);
    let enabled = names.iter().filter(|state| number(state, "disable").unwrap_or(0) == 0);
    let slowest = enabled.filter_map(|state| number(state, "latency")).max().unwrap_or(0);
    let held = std::fs::OpenOptions::new().write(true).open(root.path("/dev/cpu_dma_latency")).is_ok();
    let device = if held { "" } else { ", and /dev/cpu_dma_latency is not writable" };
    let (level, found) = match slowest <= SLOW_WAKE_UP_US {
        true => (Level::Green, format!("a core wakes up within {slowest} µs")),
        false => (Level::Yellow, format!("a core may take {slowest} µs to wake up{device}")),
    };
    Finding::new(
        "idle states",
        level,
        found,
        "100 µs at most",
        "add processor.max_cstate=1 to the kernel's command line, or keep /dev/cpu_dma_latency open with 0 written to it",
    )
}

/// Whether a core of the chain is left alone by the scheduler and by interrupts.
pub(crate) fn isolation(root: &Root<'_>, core: usize) -> [Finding; 2] {
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
    ]
}

fn interrupts_on(root: &Root<'_>, core: usize) -> usize {
    let lists = root.names("/proc/irq").into_iter().filter_map(|number| {
        root.text(&format!("/proc/irq/{number}/effective_affinity_list"))
            .filter(|list| !list.is_empty())
            .or_else(|| root.text(&format!("/proc/irq/{number}/smp_affinity_list")))
    });
    lists.filter(|list| contains(list, core)).count()
}
