//! A program that joins a run and sends on every topic what is not good: nobody dies of it, nobody follows it.
#![allow(clippy::unwrap_used)]

use bytemuck::{Pod, Zeroable};
use coact_messages::{
    Command, FieldFrame, Header, LAYOUT, Percept, Pulse, SensorSample, Speech, StopState, Truth, WorldState,
    topic,
};
use coact_pipeline::Run;
use coact_realtime::{Schedule, now};
use coact_tests::Launched;
use iceoryx2::port::publisher::Publisher;
use iceoryx2::prelude::*;
use std::fmt::Debug;
use std::time::{Duration, Instant};

/// How long it is sent what is not good: most of the run.
const SPOOFED: Duration = Duration::from_secs(18);
/// How often: more often than the set's own messages come.
const PAUSE: Duration = Duration::from_micros(500);

/// Sends one kind of message, as a program of the same user can.
struct Spoofer<T: Debug + ZeroCopySend + 'static> {
    publisher: Publisher<ipc::Service, T, ()>,
}

impl<T: Pod + Debug + ZeroCopySend> Spoofer<T> {
    fn join(node: &Node<ipc::Service>, topic: &str) -> Self {
        let name = ServiceName::new(topic).unwrap();
        let service = node.service_builder(&name).publish_subscribe::<T>().open().unwrap();
        let builder = service.publisher_builder().backpressure_strategy(BackpressureStrategy::DiscardData);
        Self { publisher: builder.create().unwrap() }
    }

    /// A message that begins with `header`, and holds this byte everywhere else.
    fn send(&self, header: Header, fill: u8) {
        let sample = self.publisher.loan_uninit().unwrap();
        let mut message: Box<T> = bytemuck::zeroed_box();
        let bytes = bytemuck::bytes_of_mut(&mut *message);
        bytes.fill(fill);
        bytes[..size_of::<Header>()].copy_from_slice(bytemuck::bytes_of(&header));
        sample.write_payload(*message).send().unwrap();
    }

    /// Other layouts, garbage, NaN, old, repeated, backward and future cycles, another generation.
    fn spoof(&self, tick: u64) {
        let stamp = now();
        let next = Header {
            layout: LAYOUT,
            generation: 0,
            sequence: u64::from(u32::MAX),
            cycle: tick,
            sensor_ns: stamp,
            published_ns: stamp,
            ..Header::zeroed()
        };
        self.send(Header { layout: LAYOUT + 1, ..next }, 0);
        self.send(bytemuck::cast([0xff_u8; size_of::<Header>()]), 0xff);
        self.send(Header { cycle: tick + 1500, ..next }, 0);
        self.send(Header { published_ns: u64::MAX, ..next }, 0);
        self.send(Header { cycle: tick.saturating_sub(6000), ..next }, 0);
        self.send(Header { cycle: tick.saturating_sub(10), ..next }, 0);
        self.send(Header { sequence: 1, ..next }, 0);
        // Words of ones are NaN.
        self.send(next, 0xff);
        self.send(next, 0);
        self.send(Header { generation: 1, ..next }, 0);
        self.send(Header { generation: u32::MAX, ..next }, 0);
    }
}

fn node(run: &Run) -> Node<ipc::Service> {
    let file = run.directory().join("config/iceoryx2.toml");
    let config = Config::from_file(&FilePath::new(file.as_os_str().as_encoded_bytes()).unwrap()).unwrap();
    NodeBuilder::new().config(&config).create::<ipc::Service>().unwrap()
}

fn spoof_all(run: &Run) {
    let node = node(run);
    let schedule = Schedule { start_ns: run.start_ns().unwrap().unwrap() };
    let sensors = Spoofer::<SensorSample>::join(&node, topic::SENSORS);
    let percept = Spoofer::<Percept>::join(&node, topic::PERCEPT);
    let fields = Spoofer::<FieldFrame>::join(&node, topic::FIELDS);
    let command = Spoofer::<Command>::join(&node, topic::COMMAND);
    let truth = Spoofer::<Truth>::join(&node, topic::TRUTH);
    let state = Spoofer::<WorldState>::join(&node, topic::WORLD_STATE);
    let pulse = Spoofer::<Pulse>::join(&node, &topic::pulse("fields"));
    let speech = Spoofer::<Speech>::join(&node, topic::SPEECH);
    let heard = Spoofer::<Speech>::join(&node, topic::HEARD);
    let stop = Spoofer::<StopState>::join(&node, topic::STOP);
    let begin = Instant::now();
    while begin.elapsed() < SPOOFED {
        let tick = schedule.tick_at(now());
        sensors.spoof(tick);
        percept.spoof(tick);
        fields.spoof(tick);
        command.spoof(tick);
        truth.spoof(tick);
        state.spoof(tick);
        pulse.spoof(tick);
        speech.spoof(tick);
        heard.spoof(tick);
        stop.spoof(tick);
        std::thread::sleep(PAUSE);
    }
}

#[test]
fn what_is_not_good_is_counted_and_the_assembly_goes_on() {
    let mut launched = Launched::start(&["--duration", "25", "--world", "kinematic"]);
    let run = launched.when_started();
    spoof_all(&run);
    let finished = launched.finish();
    finished.nobody_died();
    let summary = finished.summary();
    for process in ["world", "perception", "fields", "control", "monitor"] {
        let refused = summary.refused.get(process).unwrap_or_else(|| panic!("{process}: {summary:?}"));
        for reason in ["other layout", "from the future", "unknown writer", "too old"] {
            assert!(refused.get(reason).is_some_and(|count| *count > 0), "{process}, {reason}: {refused:?}");
        }
    }
    let heard = &summary.refused["world"];
    assert!(heard["implausible"] > 0 && heard["too often"] > 0, "{heard:?}");
    assert!(finished.stderr.contains("ignores a message of"), "{}", finished.stderr);
    // The set went on as if nobody else were there, though the machine had more to do.
    assert!(summary.task.achieved >= 1, "{}", finished.stderr);
    for process in ["world", "perception", "fields", "control"] {
        let cycles = finished.cycles(process);
        // The world goes on until the arm has come to rest, up to some tenths of a second.
        assert!((20_000..=25_500).contains(&cycles), "{process}: {cycles} cycles in 25 s");
    }
}
