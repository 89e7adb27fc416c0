use coact_pipeline::{Pipeline, Ready, Run};
use coact_realtime::WakeUpLateness;
use std::collections::BTreeMap;

/// Later starts of a process than this one are not looked for.
const MOST_STARTS: u32 = 1000;

/// Where a report was taken: figures mean nothing without it.
#[derive(Debug, Clone, Default, PartialEq, Eq, serde::Serialize)]
pub struct Environment {
    /// Name and release of the kernel.
    pub kernel: String,
    /// Preemption model of the kernel, as it was built or says of itself.
    pub preemption: String,
    /// Frequency governor of the first core; "none" where the kernel governs nothing.
    pub governor: String,
    /// Cores of the machine that are online.
    pub cores: usize,
    /// Every real-time process has all its memory locked.
    pub memory_locked: bool,
    /// For each process, the scheduling class that it obtained, with priority and core.
    pub schedulers: BTreeMap<String, String>,
    /// How punctual the machine itself was meanwhile; none in lockstep, where no clock runs.
    pub machine: Option<MachineReport>,
}

/// What a thread saw that did nothing but wake up beside the chain, on its core and with its priority.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize)]
pub struct MachineReport {
    /// How often it woke up.
    pub wakeups: u64,
    /// How often a whole period late, or later.
    pub late: u64,
    /// The longest that it was late by, ns.
    pub longest_ns: u64,
}

impl From<WakeUpLateness> for MachineReport {
    fn from(seen: WakeUpLateness) -> Self {
        Self { wakeups: seen.wakeups, late: seen.late, longest_ns: seen.longest_ns }
    }
}

/// Not those that this program may use: the monitor is kept off the core of the chain that it reports on.
fn cores_online() -> usize {
    let table = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    table.lines().filter(|line| line.starts_with("processor")).count()
}

impl Environment {
    /// Of the machine alone.
    pub fn of_machine() -> Self {
        let name = rustix::system::uname();
        let kernel = format!("{} {}", name.sysname().to_string_lossy(), name.release().to_string_lossy());
        let version = name.version().to_string_lossy();
        let model = version.split_whitespace().find(|word| word.starts_with("PREEMPT"));
        let governor = std::fs::read_to_string("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
        Self {
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
    pub fn of_run(run: &Run, pipeline: &Pipeline) -> Self {
        let newest =
            |process: &str| (0..MOST_STARTS).rev().find_map(|start| run.ready(process, start).ok()?);
        let entries = pipeline.processes.iter();
        let reports: Vec<(bool, Ready)> =
            entries.filter_map(|entry| Some((entry.realtime, newest(&entry.name)?))).collect();
        let mut realtime = reports.iter().filter(|(realtime, _)| *realtime).peekable();
        let memory_locked = realtime.peek().is_some() && realtime.all(|(_, ready)| ready.memory_locked);
        let schedulers = reports.iter().map(|(_, ready)| (ready.process.clone(), scheduler(ready))).collect();
        Self { memory_locked, schedulers, ..Self::of_machine() }
    }
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
