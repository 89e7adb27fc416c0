//! Cycles of the shell: two stages in threads of one program, observed through their pulses.
#![allow(clippy::unwrap_used)]

mod support;

use coact_messages::{FieldFrame, Header, LAYOUT, Percept, Pulse, topic};
use coact_period::PERIOD_NS;
use coact_realtime::{
    Bus, Candidate, Cycle, Input, Message, Output, PortError, RequestedFault, Schedule, Tick, now,
};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;
use support::TestRun;

/// As in the table below.
const LATEST_START: Duration = Duration::from_micros(700);
/// While the input of the cycle before has not come either, 0.2 ms sooner.
const ONCE_MISSED: Duration = Duration::from_micros(500);
const TABLE: &str = r#"
[[process]]
name = "perception"
program = "none"
order = 1
trigger = "timer"
[[process]]
name = "fields"
program = "none"
order = 1
trigger = "coact/percept"
latest_start_us = 700
"#;

/// Signals reach every shell of the program: one test at a time.
fn one_at_a_time() -> MutexGuard<'static, ()> {
    static LOCK: Mutex<()> = Mutex::new(());
    LOCK.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Publishes a message in each cycle up to the `last` one; later cycles publish nothing.
struct Relay<In: Message, Out: Message> {
    input: Input<In>,
    output: Output<Out>,
    last: u64,
}

impl<In: Message, Out: Message> Cycle for Relay<In, Out> {
    type Trigger = In;

    fn trigger(&mut self) -> &mut Input<In> {
        &mut self.input
    }

    fn step(&mut self, tick: Tick) -> Result<Header, PortError> {
        if tick.cycle > self.last {
            return Ok(Header {
                layout: LAYOUT,
                sequence: tick.cycle,
                cycle: tick.cycle,
                published_ns: now(),
                ..Header::default()
            });
        }
        let sensor_ns = self.input.header().map_or(tick.cycle, |header| header.cycle);
        self.output.loan()?.send(tick.cycle, sensor_ns)
    }
}

fn start<In: Message, Out: Message>(
    name: &'static str,
    run: &Path,
    topics: [&'static str; 2],
    last: u64,
) -> JoinHandle<()> {
    let run: PathBuf = run.to_owned();
    std::thread::spawn(move || {
        let process = Candidate::open(name, &run, 0).unwrap().join().unwrap();
        let [from, to] = topics;
        let input = process.bus().trigger(from).unwrap();
        let cycle = Relay::<In, Out> { input, output: process.bus().output(to).unwrap(), last };
        process.run_cycles(cycle).unwrap();
    })
}

/// Both stages, the first of which publishes nothing after `last`, and the pulses of the second.
fn chain(run: &TestRun, last: u64) -> ([JoinHandle<()>; 2], Input<Pulse>) {
    let directory = run.0.directory();
    let stages = [
        // The first stage has no input: nobody sends commands as percepts' cause here.
        start::<FieldFrame, Percept>("perception", directory, ["coact/none", topic::PERCEPT], last),
        start::<Percept, FieldFrame>("fields", directory, [topic::PERCEPT, topic::FIELDS], u64::MAX),
    ];
    let monitor = Bus::open(&run.0, "monitor", 0).unwrap();
    let pulses = monitor.input(&topic::pulse("fields")).unwrap();
    for name in ["perception", "fields"] {
        while run.0.ready(name, 0).unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(1));
        }
    }
    run.0.start(now() + 5 * PERIOD_NS).unwrap();
    (stages, pulses)
}

fn watch(pulses: &mut Input<Pulse>, seen: &mut Vec<Pulse>, enough: impl Fn(&[Pulse]) -> bool) {
    while !enough(seen) {
        pulses.each(|pulse| seen.push(*pulse)).unwrap();
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn stop(stages: [JoinHandle<()>; 2]) {
    // SAFETY: the shells of this program handle the signal as a request to stop.
    unsafe { libc::raise(libc::SIGTERM) };
    for stage in stages {
        stage.join().unwrap();
    }
}

#[test]
fn later_stage_runs_on_each_message_and_at_its_latest_start_once_they_stop() {
    let _lock = one_at_a_time();
    let run = TestRun::new(TABLE);
    let last = 100;
    let (stages, mut pulses) = chain(&run, last);
    let mut seen = Vec::new();
    watch(&mut pulses, &mut seen, |seen| seen.last().is_some_and(|pulse| pulse.header.cycle > last + 50));
    let start_ns = run.0.start_ns().unwrap().unwrap();
    stop(stages);
    let schedule = Schedule { start_ns };
    for pulse in &seen {
        assert_eq!(pulse.released_ns, schedule.release(pulse.header.cycle));
        assert!(pulse.started_ns >= pulse.released_ns && pulse.header.published_ns >= pulse.started_ns);
    }
    for pair in seen.windows(2) {
        let gap = pair[1].header.cycle - pair[0].header.cycle;
        assert_eq!(
            gap,
            1 + pair[1].skipped - pair[0].skipped,
            "a period has one cycle or is counted as skipped"
        );
    }
    let fresh: Vec<_> = seen.iter().filter(|pulse| pulse.input_received_ns > 0).collect();
    assert!(fresh.len() > 50, "{} of {last} cycles ran on a message of their own", fresh.len());
    let is_silent = |pulse: &&Pulse| pulse.header.cycle > last && pulse.input_received_ns == 0;
    let silent: Vec<_> = seen.iter().skip_while(|pulse| !is_silent(pulse)).collect();
    assert!(silent.len() > 10);
    let due = |pulse: &Pulse| Duration::from_nanos(pulse.scheduled_ns - pulse.released_ns);
    assert!([LATEST_START, ONCE_MISSED].contains(&due(silent[0])), "{:?}", due(silent[0]));
    for pulse in &silent[1..] {
        assert_eq!((pulse.input_received_ns, due(pulse)), (0, ONCE_MISSED));
        assert!(pulse.started_ns >= pulse.scheduled_ns);
    }
    let stale = silent.last().unwrap().stale - silent.first().unwrap().stale;
    assert_eq!(stale, silent.len() as u64 - 1, "each cycle without a new message is counted as stale");
}

#[test]
fn injected_slowness_lasts_fifty_cycles_and_skips_periods() {
    let _lock = one_at_a_time();
    let run = TestRun::new(TABLE);
    let (stages, mut pulses) = chain(&run, u64::MAX);
    let mut seen = Vec::new();
    watch(&mut pulses, &mut seen, |seen| seen.len() > 20);
    // SAFETY: the shells of this program handle the signal as a request to be slow.
    unsafe { libc::raise(RequestedFault::Slow.signal()) };
    let slow = |pulse: &&Pulse| pulse.header.published_ns - pulse.started_ns >= 2 * PERIOD_NS;
    watch(&mut pulses, &mut seen, |seen| seen.iter().filter(slow).count() >= 50);
    stop(stages);
    let last = seen.last().unwrap();
    assert!(
        last.skipped >= 50,
        "50 cycles of more than two periods each skip a period each: {}",
        last.skipped
    );
    assert!(last.missed >= 50, "and miss their deadline: {}", last.missed);
}

#[test]
fn readiness_tells_what_was_obtained_and_why_not_more() {
    let _lock = one_at_a_time();
    let table = "[[process]]\nname = \"world\"\nprogram = \"none\"\norder = 1\nrealtime = true\npriority = 7\n\
                 core = 1000\ntrigger = \"timer\"\n";
    let run = TestRun::new(table);
    let directory = run.0.directory().to_owned();
    std::thread::spawn(move || {
        Candidate::open("world", &directory, 4).unwrap().join().unwrap().report_ready().unwrap()
    })
    .join()
    .unwrap();
    let ready = run.0.ready("world", 4).unwrap().unwrap();
    let refused = |what: &str| ready.why_not.iter().any(|reason| reason.starts_with(what));
    assert!(refused("core 1000: "), "{:?}", ready.why_not);
    assert_eq!(ready.memory_locked, !refused("memory lock: "));
    let expected = if refused("SCHED_FIFO 7: ") { ("SCHED_OTHER", 0) } else { ("SCHED_FIFO", 7) };
    assert_eq!((ready.scheduler.as_str(), ready.priority), expected);
    assert_eq!((ready.pid, ready.resumed), (std::process::id(), false));
}

#[test]
fn table_that_starts_a_process_by_something_else_than_its_input_is_refused() {
    let _lock = one_at_a_time();
    let run = TestRun::new(&TABLE.replace("coact/percept", "coact/sensors"));
    let process = Candidate::open("fields", run.0.directory(), 0).unwrap().join().unwrap();
    let input: Input<Percept> = process.bus().trigger(topic::PERCEPT).unwrap();
    let output: Output<FieldFrame> = process.bus().output(topic::FIELDS).unwrap();
    let error = process.run_cycles(Relay { input, output, last: 0 }).unwrap_err().to_string();
    assert!(
        error.contains("process fields: its trigger in the process table is \"coact/sensors\""),
        "{error}"
    );
    assert!(error.contains("expected \"timer\" or \"coact/percept\""), "{error}");
}
