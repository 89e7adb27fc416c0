//! A run of its own for each test, and helpers to be a process of it.
#![allow(dead_code, clippy::unwrap_used, reason = "each test binary uses a part of this")]

use coact_period::PERIOD_NS;
use coact_pipeline::{Ready, Run, RunSettings};
use std::process::{Child, Command, Stdio};

/// A run that is removed when the test ends, however it ends.
pub struct TestRun(pub Run);

impl TestRun {
    /// A run with this process table; none of its other files exist.
    pub fn new(pipeline: &str) -> Self {
        let table = std::env::temp_dir().join(format!("coact-test-{}-{}.toml", std::process::id(), unique()));
        std::fs::write(&table, pipeline).unwrap();
        Self(Run::create(RunSettings { pipeline: table, ..RunSettings::default() }).unwrap())
    }
}

impl TestRun {
    /// A run that started two seconds ago, of which this program is all processes, in their first start.
    pub fn started() -> Self {
        let own = Self::new(TABLE);
        own.0.start(coact_realtime::now() - 2000 * PERIOD_NS).unwrap();
        ["world", "perception", "fields", "control"].iter().for_each(|name| ready(&own.0, name, 0));
        own
    }
}

/// Reports that this program is the process `name` of `run`, in this generation.
pub fn ready(run: &Run, name: &str, generation: u32) {
    let pid = std::process::id();
    run.report_ready(&Ready { process: name.to_owned(), generation, pid, ..Ready::default() }).unwrap();
}

impl Drop for TestRun {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0.settings().pipeline);
        let _ = self.0.remove();
    }
}

fn unique() -> usize {
    static COUNT: std::sync::atomic::AtomicUsize = std::sync::atomic::AtomicUsize::new(0);
    COUNT.fetch_add(1, std::sync::atomic::Ordering::Relaxed)
}

/// Variable in which a child test finds its run directory.
pub const RUN_VARIABLE: &str = "COACT_TEST_RUN";

/// Starts the ignored test `name` of this binary as a process of its own.
pub fn spawn(name: &str, run: &Run) -> Child {
    Command::new(std::env::current_exe().unwrap())
        .args(["--exact", name, "--ignored", "--nocapture"])
        .env(RUN_VARIABLE, run.directory())
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap()
}

/// In such a child: its run; `None` when somebody runs the ignored tests by hand.
pub fn child_run() -> Option<Run> {
    std::env::var_os(RUN_VARIABLE).map(|directory| Run::load(directory.as_ref()).unwrap())
}

/// A process table with one timer-driven process called "fields".
pub const TABLE: &str = r#"
[[process]]
name = "fields"
program = "none"
order = 1
trigger = "timer"
"#;
