//! The kernel itself.

use crate::root::Root;
use crate::{Finding, Level};

/// Least share of each period that real-time processes must get, of 1: the chain needs less than half of a core.
const LEAST_SHARE: f64 = 0.5;

pub(crate) fn preemption(root: &Root<'_>) -> Finding {
    let version = root.text("/proc/version").unwrap_or_default();
    let words = root.text("/proc/cmdline").unwrap_or_default();
    let mode = root.text("/sys/kernel/debug/sched/preempt").unwrap_or_default();
    let is_full = mode.contains("(full)") || words.split_whitespace().any(|word| word == "preempt=full");
    let model = version.split_whitespace().find(|word| word.starts_with("PREEMPT"));
    let (level, found) = match model {
        Some("PREEMPT_RT") => (Level::Green, "PREEMPT_RT".to_owned()),
        Some("PREEMPT_DYNAMIC") if is_full => (Level::Green, "PREEMPT_DYNAMIC, full".to_owned()),
        Some("PREEMPT") => (Level::Green, "PREEMPT".to_owned()),
        Some(model) => (Level::Yellow, format!("{model}, not known to be full")),
        None => (Level::Yellow, "not stated".to_owned()),
    };
    Finding::new(
        "preemption",
        level,
        found,
        "PREEMPT_RT, or full preemption",
        "add preempt=full to the kernel's command line (rt-config/system/README.md, step 4)",
    )
}

pub(crate) fn throttling(root: &Root<'_>) -> Finding {
    let number = |path| root.text(path).and_then(|text| text.parse::<f64>().ok());
    let runtime = number("/proc/sys/kernel/sched_rt_runtime_us");
    let period = number("/proc/sys/kernel/sched_rt_period_us").unwrap_or(1e6);
    let (level, found) = match runtime {
        Some(runtime) if runtime < 0.0 => {
            (Level::Yellow, "off: a cycle that never ends blocks its core".to_owned())
        }
        Some(runtime) => {
            let share = runtime / period;
            let level = if share >= LEAST_SHARE { Level::Green } else { Level::Red };
            (level, format!("real-time processes get {:.0} % of a core", 100.0 * share))
        }
        None => (Level::Yellow, "not readable".to_owned()),
    };
    Finding::new(
        "throttling",
        level,
        found,
        "at least 50 %, and not all of a core",
        "install rt-config/system/sysctl.d/coact.conf",
    )
}

pub(crate) fn clock_source(root: &Root<'_>) -> Finding {
    let found = root.text("/sys/devices/system/clocksource/clocksource0/current_clocksource");
    let level = match found.as_deref() {
        Some("hpet" | "acpi_pm") | None => Level::Yellow,
        Some("jiffies" | "refined-jiffies") => Level::Red,
        Some(_) => Level::Green,
    };
    Finding::new(
        "clock source",
        level,
        found.unwrap_or_else(|| "not readable".into()),
        "one that is read without a device: tsc, kvm-clock, arch_sys_counter",
        "see dmesg for why the kernel gave up the tsc; clocksource=tsc tsc=reliable on its command line if that is unfounded",
    )
}
