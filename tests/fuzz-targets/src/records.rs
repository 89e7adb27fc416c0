//! What runs leave and what is recorded of people, and what processes of a run tell each other in files.

use crate::configuration::{learned, taken};
use crate::scratch::Scratch;
use coact_monitor::{IntervalLog, Metrics};
use coact_person::RecordedWays;
use coact_pipeline::Run;
use coact_recordings::{ArmRecording, ArmSide, BodyRecording, Order, read_file};
use coact_run_records::{Event, Record, RunLog, Snapshot, Summary, SupervisorEvent};
use std::path::Path;

pub(crate) fn recording(bytes: &[u8]) -> bool {
    Scratch::with("reaches.csv", bytes, is_recording)
}

pub(crate) fn compressed_recording(bytes: &[u8]) -> bool {
    Scratch::with("reaches.csv.gz", bytes, is_recording)
}

fn is_recording(path: &Path) -> bool {
    taken(read_file(path)).is_some_and(|reaches| {
        Order::Trial { seed: 1 }.people(&reaches);
        true
    })
}

pub(crate) fn motion_capture(bytes: &[u8]) -> bool {
    Scratch::with("arms.csv", bytes, |path| {
        let arms = [ArmSide::Left, ArmSide::Right].map(|side| taken(ArmRecording::read(path, side)));
        arms.iter().flatten().for_each(|arm| assert!(arm.seen() <= arm.duration, "{arm:?}"));
        let body = taken(BodyRecording::read(path));
        arms.iter().any(Option::is_some) || body.is_some()
    })
}

pub(crate) fn recorded_ways(bytes: &[u8]) -> bool {
    Scratch::with("carries.csv", bytes, |path| taken(RecordedWays::load(path)).is_some())
}

pub(crate) fn event_log(bytes: &[u8]) -> bool {
    Scratch::with(Event::FILE, bytes, |path| {
        learned(path);
        taken(RunLog::<Event>::read_file(path)).is_some()
    })
}

pub(crate) fn supervisor_log(bytes: &[u8]) -> bool {
    log::<SupervisorEvent>(bytes)
}

pub(crate) fn snapshot_log(bytes: &[u8]) -> bool {
    log::<Snapshot>(bytes)
}

fn log<R: Record>(bytes: &[u8]) -> bool {
    Scratch::with(R::FILE, bytes, |path| taken(RunLog::<R>::read_file(path)).is_some())
}

pub(crate) fn summary(bytes: &[u8]) -> bool {
    Scratch::with(Summary::FILE, bytes, |path| taken(Summary::read(path.parent().unwrap())).is_some())
}

pub(crate) fn interval_log(bytes: &[u8]) -> bool {
    Scratch::with("end-to-end.hlog", bytes, |path| taken(IntervalLog::read(path)).is_some())
}

pub(crate) fn latency_counters(bytes: &[u8]) -> bool {
    Scratch::with("latency/counters.json", bytes, |path| {
        taken(Metrics::load(path.parent().unwrap())).is_some()
    })
}

/// The folder of a run must have the run's name.
const RUN: &str = "coact_1";

pub(crate) fn run_description(bytes: &[u8]) -> bool {
    Scratch::with(&format!("{RUN}/run.json"), bytes, |path| {
        taken(Run::load(path.parent().unwrap())).is_some()
    })
}

pub(crate) fn run_owner(bytes: &[u8]) -> bool {
    Scratch::with(&format!("{RUN}/owner.json"), bytes, |_| taken(run().owner()).is_some())
}

pub(crate) fn readiness(bytes: &[u8]) -> bool {
    taken(run().start_ns());
    Scratch::with(&format!("{RUN}/ready/fields.0.json"), bytes, |_| {
        taken(run().ready("fields", 0)).is_some_and(|ready| ready.is_some())
    })
}

pub(crate) fn start(bytes: &[u8]) -> bool {
    Scratch::with(&format!("{RUN}/start"), bytes, |_| taken(run().start_ns()).is_some())
}

fn run() -> Run {
    let description = include_bytes!("../corpus/run-description/good.json");
    Run::load(Scratch::file(&format!("{RUN}/run.json"), description).parent().unwrap()).unwrap()
}
