//! Ports: messages lie in the run's own shared memory, the newest counts, and what is not good is ignored.
#![allow(clippy::unwrap_used)]

mod support;

use bytemuck::Zeroable;
use coact_messages::{
    FieldFrame, Header, LAYOUT, Percept, Pulse, Refusal, StopState, Truth, WorldState, topic,
};
use coact_period::PERIOD_NS;
use coact_pipeline::{Run, RunSettings};
use coact_realtime::{Bus, Input, Output, PortError, Schedule, now};
use iceoryx2::prelude::*;
use support::{TestRun, ready};

fn send(output: &mut coact_realtime::Output<Percept>, cycle: u64) {
    let mut loan = output.loan().unwrap();
    loan.act[0] = 1.0 / cycle as f64;
    loan.send(cycle, 42).unwrap();
}

/// The shared-memory file in which `address` lies, if it lies in one.
fn file_at(address: usize) -> Option<String> {
    let maps = std::fs::read_to_string("/proc/self/maps").unwrap();
    let line = maps.lines().find(|line| {
        let (first, last) = line.split_whitespace().next().unwrap().split_once('-').unwrap();
        let parse = |text| usize::from_str_radix(text, 16).unwrap();
        (parse(first)..parse(last)).contains(&address)
    })?;
    line.split_whitespace().nth(5).map(str::to_owned)
}

#[test]
fn message_is_written_and_read_in_the_shared_memory_of_its_run() {
    let run = TestRun::started();
    let bus = Bus::open(&run.0, "fields", 0).unwrap();
    let mut input: Input<FieldFrame> = bus.input(topic::FIELDS).unwrap();
    let mut output = bus.output::<FieldFrame>(topic::FIELDS).unwrap();
    let mut loan = output.loan().unwrap();
    loan.activity[7] = 1.5;
    let written_at = file_at(&raw const loan.activity as usize).unwrap();
    loan.send(1, 2).unwrap();
    input.refresh().unwrap();
    let frame = input.latest().unwrap();
    assert_eq!(frame.activity[7], 1.5);
    let read_at = file_at(&raw const frame.activity as usize).unwrap();
    assert_eq!(written_at, read_at);
    assert!(read_at.starts_with(&format!("/dev/shm/{}", run.0.prefix())), "{read_at}");
}

#[test]
fn header_tells_where_the_message_comes_from() {
    let run = TestRun::started();
    ready(&run.0, "perception", 3);
    let bus = Bus::open(&run.0, "perception", 3).unwrap();
    let mut input: Input<Percept> = bus.input(topic::PERCEPT).unwrap();
    let mut output = bus.output::<Percept>(topic::PERCEPT).unwrap();
    send(&mut output, 10);
    send(&mut output, 11);
    let before = coact_realtime::now();
    input.refresh().unwrap();
    let header = *input.header().unwrap();
    assert_eq!((header.layout, header.generation, header.sequence), (LAYOUT, 3, 1));
    assert_eq!((header.cycle, header.sensor_ns, header.reserved), (11, 42, 0));
    assert!(header.published_ns <= before && input.received_ns() >= before);
}

#[test]
fn refresh_keeps_the_newest_and_tells_whether_it_is_newer() {
    let run = TestRun::started();
    let bus = Bus::open(&run.0, "perception", 0).unwrap();
    let mut input: Input<Percept> = bus.input(topic::PERCEPT).unwrap();
    let mut output = bus.output::<Percept>(topic::PERCEPT).unwrap();
    assert!(!input.refresh().unwrap() && input.latest().is_none());
    for cycle in 1..=20 {
        send(&mut output, cycle);
    }
    assert!(input.refresh().unwrap());
    assert_eq!(input.latest().unwrap().act[0], 1.0 / 20.0);
    assert!(!input.refresh().unwrap(), "the same message again is not newer");
    assert_eq!(input.latest().unwrap().act[0], 1.0 / 20.0);
}

#[test]
fn late_message_of_a_dead_writer_does_not_replace_its_successors() {
    let run = TestRun::started();
    let bus = Bus::open(&run.0, "perception", 0).unwrap();
    let replacement = Bus::open(&run.0, "perception", 1).unwrap();
    ready(&run.0, "perception", 1);
    let mut dead = bus.output::<Percept>(topic::PERCEPT).unwrap();
    let mut successor = replacement.output::<Percept>(topic::PERCEPT).unwrap();
    let mut input: Input<Percept> = bus.input(topic::PERCEPT).unwrap();
    send(&mut successor, 9);
    input.refresh().unwrap();
    send(&mut dead, 8);
    assert!(!input.refresh().unwrap());
    assert_eq!(input.header().unwrap().cycle, 9);
}

#[test]
fn reader_that_joins_late_gets_the_last_message_with_the_next_one_at_the_latest() {
    let run = TestRun::started();
    let bus = Bus::open(&run.0, "perception", 0).unwrap();
    let mut output = bus.output::<Percept>(topic::PERCEPT).unwrap();
    send(&mut output, 1);
    let mut input: Input<Percept> = bus.input(topic::PERCEPT).unwrap();
    send(&mut output, 2);
    let mut seen = Vec::new();
    input.each(|percept| seen.push(percept.header.cycle)).unwrap();
    assert_eq!(seen, [1, 2]);
}

#[test]
fn reader_of_pulses_misses_none_while_it_falls_behind_by_half_a_second() {
    let run = TestRun::started();
    let bus = Bus::open(&run.0, "monitor", 0).unwrap();
    let topic = topic::pulse("fields");
    let mut input: Input<Pulse> = bus.input(&topic).unwrap();
    let mut output = bus.output::<Pulse>(&topic).unwrap();
    for cycle in 0..500 {
        output.loan().unwrap().send(cycle, 0).unwrap();
    }
    let mut expected = 0;
    let count = input.each(|pulse| {
        assert_eq!(pulse.header.cycle, expected);
        expected += 1;
    });
    assert_eq!(count.unwrap(), 500);
}

#[test]
fn writer_is_not_delayed_by_a_reader_that_never_reads() {
    let run = TestRun::started();
    let bus = Bus::open(&run.0, "perception", 0).unwrap();
    let mut hung: Input<Percept> = bus.input(topic::PERCEPT).unwrap();
    let mut output = bus.output::<Percept>(topic::PERCEPT).unwrap();
    for cycle in 1..=1000 {
        send(&mut output, cycle);
    }
    hung.refresh().unwrap();
    assert_eq!(hung.header().unwrap().cycle, 1000);
}

/// A program of the same user that joins the run by itself, and sends `percept` as it is.
fn send_as_stranger(run: &TestRun, percept: Percept) {
    let mut config = Config::default();
    config.global.prefix = FileName::new(run.0.prefix().as_bytes()).unwrap();
    config.global.set_root_path(&Path::new(run.0.iceoryx2_root().as_os_str().as_encoded_bytes()).unwrap());
    let node = NodeBuilder::new().config(&config).create::<ipc::Service>().unwrap();
    let name = ServiceName::new(topic::PERCEPT).unwrap();
    let service = node.service_builder(&name).publish_subscribe::<Percept>().open().unwrap();
    let publisher = service.publisher_builder().create().unwrap();
    publisher.send_copy(percept).unwrap();
    // The reader connects while the sender lives; what it took in outlives it.
    std::mem::forget((node, service, publisher));
}

fn refused(bus: &Bus) -> Vec<(Refusal, u32)> {
    let counts = bus.refusals().counts();
    Refusal::ALL.into_iter().zip(counts).filter(|(_, count)| *count > 0).collect()
}

#[test]
fn message_of_another_layout_is_ignored_and_counted_and_the_one_before_it_stays() {
    let run = TestRun::started();
    let bus = Bus::open(&run.0, "perception", 0).unwrap();
    let mut input: Input<Percept> = bus.input(topic::PERCEPT).unwrap();
    let mut output = bus.output::<Percept>(topic::PERCEPT).unwrap();
    send(&mut output, 7);
    assert!(input.refresh().unwrap());
    let mut percept = Percept::zeroed();
    percept.header = Header { layout: LAYOUT + 1, cycle: 8, ..Header::zeroed() };
    send_as_stranger(&run, percept);
    assert!(!input.refresh().unwrap());
    assert_eq!(input.header().unwrap().cycle, 7);
    assert_eq!(refused(&bus), [(Refusal::Layout, 1)]);
    let index = bus.refusals().topic() as usize;
    assert_eq!(topic::ALL[index].name, topic::PERCEPT);
    send(&mut output, 9);
    assert!(input.refresh().unwrap(), "its writer is heard as before");
}

#[test]
fn who_is_not_the_topics_process_is_not_heard_whatever_generation_he_says() {
    let run = TestRun::started();
    let bus = Bus::open(&run.0, "perception", 0).unwrap();
    let mut input: Input<Percept> = bus.input(topic::PERCEPT).unwrap();
    let mut output = bus.output::<Percept>(topic::PERCEPT).unwrap();
    for (generation, reason) in [(0, Refusal::Writer), (1, Refusal::Writer), (u32::MAX, Refusal::Writer)] {
        send(&mut output, 10);
        assert!(input.refresh().unwrap());
        let before = bus.refusals().counts()[reason as usize];
        let mut percept = Percept::zeroed();
        percept.header = Header { layout: LAYOUT, generation, sequence: 99, cycle: 11, ..Header::zeroed() };
        send_as_stranger(&run, percept);
        assert!(!input.refresh().unwrap(), "generation {generation}");
        assert_eq!(bus.refusals().counts()[reason as usize], before + 1, "generation {generation}");
    }
}

#[test]
fn what_the_writer_itself_garbles_is_ignored_and_the_message_before_it_stays() {
    let run = TestRun::started();
    let bus = Bus::open(&run.0, "perception", 0).unwrap();
    let mut input: Input<Percept> = bus.input(topic::PERCEPT).unwrap();
    let mut output = bus.output::<Percept>(topic::PERCEPT).unwrap();
    let garble: [fn(&mut Percept); 5] = [
        |percept| percept.act[100] = f64::NAN,
        |percept| percept.achieved[63] = 1.5,
        |percept| percept.arms[0].elbow.position[2] = f64::INFINITY,
        |percept| percept.workspace[1].orientation[31] = [9.0; 4],
        |percept| bytemuck::bytes_of_mut(&mut percept.hand).fill(0xff),
    ];
    for (index, garble) in garble.into_iter().enumerate() {
        let cycle = 10 * index as u64 + 10;
        output.loan().unwrap().send(cycle, 0).unwrap();
        assert!(input.refresh().unwrap());
        let mut loan = output.loan().unwrap();
        garble(&mut loan);
        loan.send(cycle + 1, 0).unwrap();
        assert!(!input.refresh().unwrap(), "{index}");
        assert_eq!(input.header().unwrap().cycle, cycle);
        // Memory is loaned again with what it held.
        *output.loan().unwrap() = Percept::zeroed();
    }
    assert_eq!(refused(&bus), [(Refusal::Implausible, 5)]);
}

#[test]
fn message_of_a_cycle_to_come_starts_no_cycle() {
    let run = TestRun::started();
    let bus = Bus::open(&run.0, "perception", 0).unwrap();
    let mut input: Input<Percept> = bus.trigger(topic::PERCEPT).unwrap();
    let mut output = bus.output::<Percept>(topic::PERCEPT).unwrap();
    send(&mut output, 1_000_000);
    assert!(!input.wait_for(2000, coact_realtime::now() + coact_period::PERIOD_NS).unwrap());
    assert_eq!(refused(&bus), [(Refusal::Future, 1)]);
}

#[test]
fn closed_topics_are_for_their_readers_alone() {
    let run = TestRun::started();
    for process in ["world", "perception", "fields", "control", "voice", "supervisor"] {
        let bus = Bus::open(&run.0, process, 0).unwrap();
        assert!(matches!(bus.input::<Truth>(topic::TRUTH), Err(PortError::Closed { .. })));
        assert!(matches!(bus.trigger::<Truth>(topic::TRUTH), Err(PortError::Closed { .. })));
    }
    let fields = Bus::open(&run.0, "fields", 0).unwrap();
    let error = fields.input::<WorldState>(topic::WORLD_STATE).unwrap_err().to_string();
    assert!(error.contains("fields may not read coact/world-state; expected supervisor"), "{error}");
    let world = Bus::open(&run.0, "world", 0).unwrap();
    let monitor = Bus::open(&run.0, "monitor", 0).unwrap();
    let mut truth: Input<Truth> = monitor.input(topic::TRUTH).unwrap();
    let mut output = world.output::<Truth>(topic::TRUTH).unwrap();
    output.loan().unwrap().send(5, 0).unwrap();
    assert!(truth.refresh().unwrap());
}

#[test]
fn waiting_ends_with_the_message_and_not_with_its_event_alone() {
    let run = TestRun::started();
    let bus = Bus::open(&run.0, "fields", 0).unwrap();
    let mut input: Input<Percept> = bus.trigger(topic::PERCEPT).unwrap();
    let mut output = bus.output::<Percept>(topic::PERCEPT).unwrap();
    send(&mut output, 4);
    let soon = || coact_realtime::now() + 3 * coact_period::PERIOD_NS;
    assert!(input.wait_for(4, soon()).unwrap(), "the message of cycle 4 is there");
    send(&mut output, 5);
    let until = soon();
    assert!(!input.wait_for(6, until).unwrap(), "an event for cycle 5 does not start cycle 6");
    assert!(coact_realtime::now() >= until);
}

#[test]
fn runs_beside_each_other_do_not_hear_each_other_and_leave_nothing() {
    let (first, second) = (TestRun::started(), TestRun::started());
    let (prefix, directory) = (first.0.prefix(), first.0.directory().to_owned());
    let bus = Bus::open(&first.0, "perception", 0).unwrap();
    let other = Bus::open(&second.0, "fields", 0).unwrap();
    let mut output = bus.output::<Percept>(topic::PERCEPT).unwrap();
    let mut input: Input<Percept> = other.input(topic::PERCEPT).unwrap();
    send(&mut output, 1);
    assert!(!input.refresh().unwrap());
    let files = || {
        let entries = std::fs::read_dir("/dev/shm").unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned());
        names.filter(|name| name.starts_with(&prefix)).count()
    };
    assert!(files() > 0);
    drop((output, bus));
    drop(first);
    assert_eq!(files(), 0);
    assert!(!directory.exists());
    let mut output = other.output(topic::PERCEPT).unwrap();
    send(&mut output, 7);
    assert!(input.refresh().unwrap(), "the other run goes on");
}

/// Says as the supervisor of this generation that the robot may move. Its port and bus are to live until that is heard.
fn say_as_supervisor(run: &Run, generation: u32) -> (Output<StopState>, Bus) {
    let bus = Bus::open(run, "supervisor", generation).unwrap();
    let mut output: Output<StopState> = bus.output(topic::STOP).unwrap();
    let mut message = output.loan().unwrap();
    (message.stopped, message.reserved) = (0, 0);
    let schedule = Schedule { start_ns: run.start_ns().unwrap().unwrap() };
    message.send(schedule.tick_at(now()), now()).unwrap();
    (output, bus)
}

#[test]
fn a_successor_of_the_supervisor_is_heard_and_nobody_who_says_to_be_another_one() {
    let owned = Run::create(RunSettings::default()).unwrap();
    owned.start(now() - 2000 * PERIOD_NS).unwrap();
    let run = Run::load(owned.directory()).unwrap();
    let bus = Bus::open(&run, "world", 0).unwrap();
    let mut heard: Input<StopState> = bus.input(topic::STOP).unwrap();
    let hears = |heard: &mut Input<StopState>, generation| {
        let _speaker = say_as_supervisor(&run, generation);
        heard.refresh().unwrap()
    };
    assert!(!hears(&mut heard, 1), "nobody has adopted the run yet");
    assert!(hears(&mut heard, 0));
    let member = run.become_member().unwrap();
    drop(owned);
    let adopted = run.adopt().unwrap();
    for generation in [0, 2] {
        assert!(!hears(&mut heard, generation), "{generation}");
    }
    assert!(hears(&mut heard, 1));
    drop((heard, bus, member));
    adopted.remove().unwrap();
}

/// Why the supervisor removes what killed processes leave empty. Once iceoryx2 gives such a file up by itself, that is not needed any more.
#[test]
fn whoever_opens_memory_that_was_left_without_a_size_waits_until_it_is_removed() {
    let run = TestRun::started();
    let writer = Bus::open(&run.0, "perception", 0).unwrap();
    let before = files(&run.0);
    let output = writer.output::<Percept>(topic::PERCEPT).unwrap();
    let made: Vec<_> = files(&run.0).into_iter().filter(|file| !before.contains(file)).collect();
    // As they are between being named and being given a size. Nobody touches what the writer has mapped of them.
    made.iter().for_each(|file| std::fs::File::create(file).map(drop).unwrap());
    let opening = std::thread::spawn({
        let run = run.0.clone();
        move || {
            let bus = Bus::open(&run, "fields", 0).unwrap();
            bus.input::<Percept>(topic::PERCEPT).map(drop).map_err(|error| error.to_string())
        }
    });
    std::thread::sleep(std::time::Duration::from_secs(1));
    assert!(!opening.is_finished(), "{made:?}");
    made.iter().for_each(|file| std::fs::remove_file(file).unwrap());
    let begin = std::time::Instant::now();
    while !opening.is_finished() && begin.elapsed() < std::time::Duration::from_secs(60) {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    assert!(opening.is_finished(), "it waits for what is gone");
    std::mem::forget(output);
}

/// The run's files in shared memory.
fn files(run: &Run) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(run.directory().parent().unwrap()).unwrap().map(Result::unwrap);
    let own = entries.filter(|entry| entry.file_name().to_string_lossy().starts_with(&run.prefix()));
    own.filter(|entry| entry.path().is_file()).map(|entry| entry.path()).collect()
}
