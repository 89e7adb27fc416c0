//! Where a report was taken.

use coact_pipeline::{Pipeline, Ready, Run};
use coact_realtime::WakeUpLateness;
use coact_run_records::{Environment, MachineReport};
use std::collections::BTreeMap;

/// Later starts of a process than this one are not looked for: no restart policy allows so many.
const MOST_STARTS: u32 = 1000;

/// Of the machine alone.
pub fn of_machine() -> Environment {
    let name = rustix::system::uname();
    let kernel = format!("{} {}", name.sysname().to_string_lossy(), name.release().to_string_lossy());
    let version = name.version().to_string_lossy();
    let model = version.split_whitespace().find(|word| word.starts_with("PREEMPT"));
    let governor = std::fs::read_to_string("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
    Environment {
        kernel,
        preemption: model.unwrap_or("not stated").to_owned(),
        governor: governor.map_or_else(|_| "none".into(), |governor| governor.trim().to_owned()),
        cores: cores_online(),
        memory_locked: false,
        schedulers: BTreeMap::new(),
        machine: None,
    }
}

/// Of the machine and of a run's processes, as their newest reports of readiness say.
pub fn of_run(run: &Run, pipeline: &Pipeline) -> Environment {
    let newest = |process: &str| (0..MOST_STARTS).rev().find_map(|start| run.ready(process, start).ok()?);
    let entries = pipeline.processes.iter();
    let reports: Vec<(bool, Ready)> =
        entries.filter_map(|entry| Some((entry.realtime, newest(&entry.name)?))).collect();
    let mut realtime = reports.iter().filter(|(realtime, _)| *realtime).peekable();
    let memory_locked = realtime.peek().is_some() && realtime.all(|(_, ready)| ready.memory_locked);
    let schedulers = reports.iter().map(|(_, ready)| (ready.process.clone(), scheduler(ready))).collect();
    Environment { memory_locked, schedulers, ..of_machine() }
}

/// What the latency probe saw of the machine.
pub fn of_probe(seen: &WakeUpLateness) -> MachineReport {
    MachineReport {
        wakeups: seen.wakeups,
        late: seen.late,
        p999_ns: seen.p999_ns,
        longest_ns: seen.longest_ns,
    }
}

/// All of the machine: the monitor itself may not use the core that the real-time processes run on.
fn cores_online() -> usize {
    let table = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    table.lines().filter(|line| line.starts_with("processor")).count()
}

fn scheduler(ready: &Ready) -> String {
    let mut text = ready.scheduler.clone();
    if ready.priority > 0 {
        text.push_str(&format!(" {}", ready.priority));
    }
    if let Some(core) = ready.core {
        text.push_str(&format!(" on core {core}"));
    }
    text
}
