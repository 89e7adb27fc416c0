//! Every example runs and prints what it promises.
//!
//! Cargo builds the examples of a package before its tests; they are started as a person starts them.
#![allow(clippy::unwrap_used)]

use coact_examples::HandSpeed;
use coact_messages::{FieldFrame, LAYOUT, Percept, Pulse, topic};
use coact_period::{PERIOD, PERIOD_NS};
use coact_pipeline::{Ready, Run, RunSettings};
use coact_realtime::{Bus, Input, Message, Output, now};
use rustix::process::{Pid, Signal, kill_process};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Longer than anything here takes on a loaded machine.
const PATIENCE: Duration = Duration::from_secs(60);

fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The program of an example: cargo puts it beside the folder of the tests' own programs.
fn example(name: &str) -> Command {
    let test = std::env::current_exe().unwrap();
    let program = test.parent().unwrap().parent().unwrap().join("examples").join(name);
    assert!(program.is_file(), "{} is missing: cargo build -p coact-examples --examples", program.display());
    Command::new(program)
}

/// What a program prints that ends well.
fn printed(mut program: Command) -> String {
    let output = program.output().unwrap();
    assert!(output.status.success(), "{program:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// A run without a supervisor, removed when the test ends.
struct TestRun(Run);

impl TestRun {
    fn new(pipeline: PathBuf) -> Self {
        let shipped = RunSettings::shipped(&folder().join("../rt-config"));
        Self(Run::create(RunSettings { pipeline, ..shipped }).unwrap())
    }
}

impl Drop for TestRun {
    fn drop(&mut self) {
        self.0.remove().ok();
    }
}

/// Publishes a message of `topic` each period, as `process` would, until `done` says so.
fn publish<T: Message>(
    run: &Run,
    process: &str,
    topic: &str,
    fill: impl Fn(&mut T, u64),
    mut done: impl FnMut() -> bool,
) {
    let pid = std::process::id();
    run.report_ready(&Ready { process: process.to_owned(), pid, ..Ready::default() }).unwrap();
    run.start(now()).unwrap();
    let bus = Bus::open(run, process, 0).unwrap();
    let mut output: Output<T> = bus.output(topic).unwrap();
    let begin = Instant::now();
    for cycle in 0.. {
        let mut message = output.loan().unwrap();
        fill(&mut message, cycle);
        message.send(cycle, now()).unwrap();
        if done() {
            return;
        }
        assert!(begin.elapsed() < PATIENCE, "the reader of {topic} does not end");
        std::thread::sleep(PERIOD);
    }
}

/// What a program prints while `process` publishes on `topic`.
fn printed_meanwhile<T: Message>(
    mut program: Command,
    run: &Run,
    [process, topic]: [&str; 2],
    fill: impl Fn(&mut T, u64),
) -> String {
    // The topic is there before the program looks for it.
    let bus = Bus::open(run, "supervisor", 0).unwrap();
    let _kept_open: Output<T> = bus.output(topic).unwrap();
    let mut child = program.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    publish(run, process, topic, fill, || child.try_wait().unwrap().is_some());
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn field_decides_between_two_inputs() {
    let told = printed(example("two_inputs"));
    let decisions: Vec<_> = told.lines().filter_map(|line| line.split("decision: ").nth(1)).collect();
    assert_eq!(decisions, ["none", "left", "left", "right"], "{told}");
}

#[test]
fn task_made_in_code_leads_to_a_decision_before_the_reach_ends() {
    let told = printed(example("task_in_code"));
    let decision = told.lines().last().unwrap();
    assert!(decision.ends_with("decides: receive the block"), "{told}");
    let percent: u32 = decision.split(" ms, ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!((1..100).contains(&percent), "{told}");
}

#[test]
fn movement_is_planned_past_an_obstacle() {
    let told = printed(example("past_an_obstacle"));
    let lines: Vec<_> = told.lines().collect();
    assert!(lines[0].contains("directly") && lines[1].contains("through a bounce posture"), "{told}");
    let nearest: f64 = lines[2].split([' ', ':']).find_map(|word| word.parse().ok()).unwrap();
    assert!(nearest >= 2.0, "{told}");
}

#[test]
fn stage_of_one_s_own_runs_in_lockstep() {
    let told = printed(example("stage_in_lockstep"));
    assert!(told.contains("reach 1 begins") && told.contains("decides: "), "{told}");
    assert!(told.lines().last().unwrap().contains("reaches, the last one with"), "{told}");
}

#[test]
fn stage_of_one_s_own_runs_as_a_process() {
    let table = std::env::temp_dir().join(format!("coact-example-{}.toml", std::process::id()));
    let text = "[[process]]\nname = \"hand-speed\"\nprogram = \"none\"\norder = 1\n\
                trigger = \"coact/percept\"\nlatest_start_us = 700\n";
    std::fs::write(&table, text).unwrap();
    let run = TestRun::new(table.clone());
    let reader = Bus::open(&run.0, "test", 0).unwrap();
    let mut speeds: Input<HandSpeed> = reader.input(HandSpeed::TOPIC).unwrap();
    let mut pulses: Input<Pulse> = reader.input(&topic::pulse("hand-speed")).unwrap();
    let mut child = example("stage_as_process").arg("--run").arg(run.0.directory()).spawn().unwrap();
    let begin = Instant::now();
    while run.0.ready("hand-speed", 0).unwrap().is_none() {
        assert!(begin.elapsed() < PATIENCE && child.try_wait().unwrap().is_none(), "it is never ready");
        std::thread::sleep(PERIOD);
    }
    run.0.start(now() + 5 * PERIOD_NS).unwrap();
    let (mut seen, mut beats) = (HandSpeed::default(), 0);
    let reach = |percept: &mut Percept, _| {
        *percept = bytemuck::Zeroable::zeroed();
        (percept.arms[0].tracked, percept.hand.reaching) = (1, 1);
        percept.arms[0].wrist.velocity = [0.5, 0.0, 0.0];
    };
    // The shell sends a pulse with each cycle; a reader that is held up loses the oldest ones.
    publish(&run.0, "perception", topic::PERCEPT, reach, || {
        speeds.each(|speed| seen = *speed).unwrap();
        beats += pulses.each(|_| {}).unwrap();
        seen.now > 0.4 && beats > 20
    });
    kill_process(Pid::from_child(&child), Signal::TERM).unwrap();
    assert!(child.wait().unwrap().success());
    std::fs::remove_file(&table).unwrap();
    assert_eq!((seen.reaches, seen.reaching), (1, 1));
}

#[test]
fn topic_of_a_running_set_is_read_from_rust() {
    let run = TestRun::new(folder().join("../rt-config/pipeline.toml"));
    let mut program = example("read_topic");
    program.arg(run.0.directory());
    let decided = |frame: &mut FieldFrame, _| {
        *frame = bytemuck::Zeroable::zeroed();
        frame.decision.action = 0;
    };
    let told = printed_meanwhile(program, &run.0, ["fields", topic::FIELDS], decided);
    assert!(told.starts_with(&format!("run {}: toy vehicle", run.0.id())), "{told}");
    assert_eq!(told.lines().count(), 6, "{told}");
    assert!(told.contains("decides: insert: "), "{told}");
}

#[test]
fn topic_of_a_running_set_is_read_from_python() {
    let mut import = Command::new("python3");
    if !import
        .args(["-c", "import iceoryx2"])
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
    {
        return eprintln!("skipped: the Python package iceoryx2 is missing (pip install iceoryx2==0.10.0)");
    }
    let run = TestRun::new(folder().join("../rt-config/pipeline.toml"));
    let mut program = Command::new("python3");
    program.arg(folder().join("read_topic.py")).arg(run.0.directory());
    let punctual = |pulse: &mut Pulse, cycle: u64| {
        *pulse = Pulse { released_ns: now(), missed: cycle.min(7), ..Pulse::default() };
        pulse.started_ns = pulse.released_ns;
    };
    let told = printed_meanwhile(program, &run.0, ["control", &topic::pulse("control")], punctual);
    assert_eq!(told.lines().count(), 5, "{told}");
    assert!(told.lines().last().unwrap().ends_with("; 7 deadlines missed so far"), "{told}");
}

#[test]
fn hand_of_a_real_person_is_told_line_by_line_from_python() {
    let mut program = Command::new("python3");
    program.arg(folder().join("hand.py"));
    let told = printed(program);
    let hands: Vec<Vec<f64>> = told
        .lines()
        .map(|line| {
            let numbers = line.strip_prefix('[').and_then(|line| line.strip_suffix(']')).unwrap();
            numbers.split(',').map(|number| number.trim().parse().unwrap()).collect()
        })
        .collect();
    assert!(hands.len() > 300 && hands.iter().all(|hand| hand.len() == 5), "{told}");
    let closed = hands.iter().filter(|hand| (0.08..0.091).contains(&hand[4]) && hand[3] < -74.0).count();
    assert!(closed > 60, "{closed} lines with fingers around a wheel");
    assert_eq!(hands.first().unwrap()[..3], hands.last().unwrap()[..3], "it ends where it began");
}

/// Without the Python package nothing else would notice.
#[test]
fn programs_in_python_state_the_layout_of_the_messages() {
    for program in ["read_topic.py", "../tools/watch-layer.py"] {
        let text = std::fs::read_to_string(folder().join(program)).unwrap();
        assert!(text.contains(&format!("\nLAYOUT = {LAYOUT}")), "{program}: expected LAYOUT = {LAYOUT}");
    }
}
