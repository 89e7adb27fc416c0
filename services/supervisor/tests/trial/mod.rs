//! Sets of shell scripts, in a folder of their own.
#![allow(dead_code, reason = "each test program uses a part")]

use coact_pipeline::RestartPolicy;
use coact_run_records::{SupervisorEvent, SupervisorEventKind};
use coact_supervisor::{Checkpoints, GaveUp, ProcessSet, ProcessSpec, SupervisorLog};
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

pub const READY_AND_RUN: &str = "touch \"$READY\"; exec sleep 600";

/// A folder for ready files and report, and the set under test.
pub struct Trial {
    pub folder: tempfile::TempDir,
    pub set: ProcessSet,
    pub events: Vec<SupervisorEvent>,
}

/// The calls that it got, in order.
#[derive(Default)]
pub struct RecordedCalls(pub Vec<String>);

impl Checkpoints for RecordedCalls {
    fn publish(&mut self, process: &str) -> Option<String> {
        self.0.push(format!("publish {process}"));
        None
    }
    fn drop_newest(&mut self, process: &str) -> Option<String> {
        self.0.push(format!("drop {process}"));
        Some("its memory".into())
    }
    fn recovered(&mut self, process: &str) {
        self.0.push(format!("recovered {process}"));
    }
}

/// Others have taken all places.
pub struct Crowd;

impl Checkpoints for Crowd {
    fn publish(&mut self, _process: &str) -> Option<String> {
        None
    }
    fn recovered(&mut self, _process: &str) {}
    fn crowd(&self, _process: &str) -> Option<String> {
        Some("no place is left".into())
    }
}

pub fn script(folder: &Path, name: &str, script: &str) -> ProcessSpec {
    let script =
        format!("DIR='{}'; READY=\"$DIR/{name}.$COACT_GENERATION.json\"; {script}", folder.display());
    ProcessSpec {
        name: name.into(),
        program: "/bin/sh".into(),
        arguments: vec!["-c".into(), script.into()],
        order: 0,
        needed: true,
        realtime: false,
        core: None,
        spare: false,
        ready_directory: folder.to_owned(),
        stop_grace: Duration::from_millis(300),
        ready_within: Duration::from_secs(60),
        heartbeat_file: folder.join(format!("{name}.heartbeat")),
        hung_after: None,
    }
}

impl Trial {
    pub fn of(scripts: &[(&str, &str)]) -> Self {
        Self::with(scripts, |_| {})
    }

    pub fn with(scripts: &[(&str, &str)], change: impl Fn(&mut ProcessSpec)) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut specs: Vec<_> =
            scripts.iter().map(|(name, text)| script(folder.path(), name, text)).collect();
        specs.iter_mut().for_each(change);
        let policy = RestartPolicy {
            intensity: 3,
            window: Duration::from_secs(600),
            backoff_initial: Duration::from_millis(1),
            backoff_max: Duration::from_millis(4),
            hung_after: Duration::from_millis(300),
        };
        let log = SupervisorLog::create(folder.path()).unwrap();
        let set = ProcessSet::new(specs, policy, log, Arc::new(|_, _| {}));
        Self { folder, set, events: Vec::new() }
    }

    /// Each process in its own step: the first of `scripts` is started first.
    pub fn in_steps(scripts: &[(&str, &str)]) -> Self {
        let position = |name: &str| scripts.iter().position(|(other, _)| *other == name).unwrap();
        Self::with(scripts, |spec| spec.order = position(&spec.name) as u32)
    }

    /// Advances until `done`, or the set is given up.
    pub fn until(
        &mut self,
        checkpoints: &mut dyn Checkpoints,
        done: impl Fn(&Self) -> bool,
    ) -> Result<(), GaveUp> {
        let begin = Instant::now();
        while !done(self) {
            assert!(begin.elapsed() < Duration::from_secs(60), "it never came: {:#?}", self.events);
            self.set.wait(Duration::from_millis(2));
            let outcome = self.set.advance(checkpoints);
            self.events.extend(self.set.take_events());
            outcome?;
        }
        Ok(())
    }

    pub fn run_until_ready(&mut self) {
        self.until(&mut (), |trial| trial.set.all_ready()).unwrap();
    }

    pub fn gives_up(&mut self) -> GaveUp {
        self.until(&mut (), |_| false).unwrap_err()
    }

    pub fn pid(&self, name: &str) -> u32 {
        self.set.pids().find(|(other, _)| *other == name).unwrap().1
    }

    pub fn count(&self, kind: SupervisorEventKind, process: &str) -> usize {
        self.events.iter().filter(|event| event.event == kind && event.process == process).count()
    }

    pub fn sequence(&self) -> Vec<(SupervisorEventKind, &str)> {
        self.events.iter().map(|event| (event.event, event.process.as_str())).collect()
    }
}

pub fn exists(pid: u32) -> bool {
    Path::new(&format!("/proc/{pid}")).exists()
}
