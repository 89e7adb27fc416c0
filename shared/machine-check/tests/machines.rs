//! Made-up machines, judged.
#![allow(clippy::unwrap_used)]

use coact_machine_check::{Demand, Finding, Level, check};

/// A machine on which all is as it should be, after these changes: path and text, or no text where the file is missing.
fn judged(changes: &[(&str, Option<&str>)]) -> Vec<Finding> {
    let root = tempfile::tempdir().unwrap();
    let limits = "Limit Soft Hard Units\nMax open files            1024  16384  files\n\
                  Max locked memory         unlimited  unlimited  bytes\nMax realtime priority     95  95\n";
    let mut files: Vec<(&str, Option<&str>)> = vec![
        ("proc/version", Some("Linux version 6.12 (gcc) #1 SMP PREEMPT_RT Mon")),
        ("proc/cmdline", Some("quiet")),
        ("proc/self/limits", Some(limits)),
        ("proc/self/status", Some("Name:\tcoact\nCapEff:\t0000000000000000\n")),
        ("proc/self/cgroup", Some("0::/a/b\n")),
        ("proc/sys/kernel/sched_rt_runtime_us", Some("950000\n")),
        ("proc/sys/kernel/sched_rt_period_us", Some("1000000\n")),
        ("sys/devices/system/clocksource/clocksource0/current_clocksource", Some("tsc\n")),
        ("proc/cpuinfo", Some("processor\t: 0\nmodel: x\nprocessor\t: 1\n")),
        ("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", Some("performance\n")),
        ("sys/devices/system/cpu/cpu1/cpuidle/state1/latency", Some("2\n")),
        ("sys/devices/system/cpu/isolated", Some("1\n")),
        ("proc/irq/7/smp_affinity_list", Some("0\n")),
        ("sys/devices/virtual/workqueue/cpumask", Some("1\n")),
        ("proc/swaps", Some("Filename Type Size\n")),
        ("sys/fs/cgroup/a/b/cpu.max", Some("max 100000\n")),
        ("sys/fs/cgroup/a/memory.max", Some("max\n")),
        ("dev/shm/file", Some("")),
    ];
    files.extend(changes);
    for (path, text) in files {
        let path = root.path().join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        match text {
            Some(text) => std::fs::write(path, text).unwrap(),
            None => std::fs::remove_file(path).unwrap(),
        }
    }
    let mut findings = check(root.path(), &Demand { cores: vec![1], priority: 84 });
    // The disk on which the made-up machine lies may be full.
    findings.retain(|finding| finding.subject != "shared memory");
    findings
}

/// What is not green after a change.
fn faults(path: &str, text: Option<&str>) -> Vec<(&'static str, Level)> {
    let findings = judged(&[(path, text)]);
    let faults = findings.iter().filter(|finding| finding.level != Level::Green);
    faults.map(|finding| (finding.subject, finding.level)).collect()
}

#[test]
fn a_machine_that_suits_is_green_and_needs_nothing() {
    let findings = judged(&[]);
    assert_eq!(findings.len(), 15);
    for finding in findings {
        assert!(finding.level == Level::Green && finding.remedy.is_none(), "{finding:?}");
    }
}

#[test]
fn each_obstacle_is_found_alone_with_what_to_do() {
    let few = "Max open files 64 64 files\nMax locked memory 65536 65536 bytes\nMax realtime priority 0 0\n";
    let states = "sys/devices/system/cpu/cpu1/cpuidle/state3/latency";
    for (path, text, expected) in [
        ("proc/version", "Linux 6.1 #1 SMP PREEMPT_DYNAMIC Mon", vec![("preemption", Level::Yellow)]),
        (
            "proc/self/limits",
            few,
            vec![("scheduling", Level::Red), ("locked memory", Level::Red), ("open files", Level::Red)],
        ),
        ("proc/sys/kernel/sched_rt_runtime_us", "-1", vec![("throttling", Level::Yellow)]),
        ("proc/sys/kernel/sched_rt_runtime_us", "100000", vec![("throttling", Level::Red)]),
        (
            "sys/devices/system/clocksource/clocksource0/current_clocksource",
            "hpet",
            vec![("clock source", Level::Yellow)],
        ),
        ("proc/cpuinfo", "processor\t: 0\n", vec![("cores", Level::Red)]),
        (
            "sys/devices/system/cpu/cpu1/cpufreq/scaling_governor",
            "powersave",
            vec![("governor", Level::Yellow)],
        ),
        (states, "300", vec![("idle states", Level::Yellow)]),
        ("sys/devices/system/cpu/isolated", "", vec![("isolation", Level::Yellow)]),
        ("proc/irq/9/effective_affinity_list", "0-1", vec![("interrupts", Level::Yellow)]),
        ("sys/devices/virtual/workqueue/cpumask", "3", vec![("kernel workers", Level::Yellow)]),
        ("proc/swaps", "Filename Type\n/swap file\n", vec![("swap", Level::Yellow)]),
        ("sys/fs/cgroup/a/cpu.max", "50000 100000", vec![("cgroup processor", Level::Red)]),
        ("sys/fs/cgroup/a/b/memory.max", "268435456", vec![("cgroup memory", Level::Red)]),
    ] {
        assert_eq!(faults(path, Some(text)), expected, "{path}: {text}");
    }
    assert!(judged(&[(states, Some("300"))]).iter().any(|finding| finding.remedy.is_some()));
    // What is held, as the device tells it: four bytes, here of 0x31 and of zeros, µs.
    let with_held = |held| judged(&[(states, Some("300")), ("dev/cpu_dma_latency", Some(held))]);
    assert!(
        with_held("1111")
            .iter()
            .any(|finding| finding.subject == "idle states" && finding.level == Level::Yellow)
    );
    assert!(with_held("\0\0\0\0").iter().all(|finding| finding.level == Level::Green));
    // The other cores may sleep.
    assert_eq!(faults("sys/devices/system/cpu/cpu0/cpuidle/state3/latency", Some("300")), []);
}

#[test]
fn privileges_make_up_for_limits_and_full_preemption_for_a_dynamic_kernel() {
    let none = "Max open files 4096 4096 files\nMax locked memory 0 0 bytes\nMax realtime priority 0 0\n";
    let root = [("proc/self/limits", Some(none)), ("proc/self/status", Some("CapEff:\t000001ffffffffff\n"))];
    let dynamic = [
        ("proc/version", Some("Linux 6.1 #1 SMP PREEMPT_DYNAMIC Mon")),
        ("proc/cmdline", Some("quiet preempt=full")),
    ];
    for changes in [root, dynamic] {
        assert!(judged(&changes).iter().all(|finding| finding.level == Level::Green), "{changes:?}");
    }
}

#[test]
fn what_cannot_be_read_is_never_green_where_that_matters() {
    assert_eq!(faults("proc/self/limits", None).len(), 3);
    assert_eq!(faults("proc/sys/kernel/sched_rt_runtime_us", None), [("throttling", Level::Yellow)]);
    assert_eq!(faults("proc/version", None), [("preemption", Level::Yellow)]);
}
