//! Messages: changed ones are judged as a port does; what is good, the stages that read it use, and send what is good.

use crate::assembly::{INSTANTS, Instant, settings};
use crate::configuration::task;
use crate::patch::{patched, which};
use crate::watch::Watch;
use coact_control::Control;
use coact_fields::Network;
use coact_joint_task::NetworkPlan;
use coact_messages::{
    Command, FieldFrame, HandPoints, Percept, Plausible, Pulse, SensorSample, Speech, topic,
};
use coact_perception::{Perception, PreshapeModel};
use coact_period::PERIOD_NS;
use coact_person::HandModel;
use coact_realtime::{Judge, Message, Origin, Place};
use coact_robot::Robot;
use coact_safety::SafetyLimits;
use coact_voice::{Meanings, Voice};
use coact_world::{Partner, Settings, World};
use std::cell::RefCell;

/// The stages, to be set back to an instant before each input.
pub(crate) struct Stages {
    pub(crate) world: World,
    /// The world of a person whose hand comes from outside.
    pub(crate) live: World,
    pub(crate) perception: Perception,
    pub(crate) network: Network,
    pub(crate) control: Control,
}

/// So many periods the world lives with what it was told: some frames of its cameras.
const SEEN: u64 = 40;

thread_local! {
    static STAGES: RefCell<Option<Stages>> = const { RefCell::new(None) };
}

impl Stages {
    fn new() -> Self {
        let settings = settings();
        let robot = Robot::load(&settings.robot).unwrap();
        let limits = SafetyLimits::load(&settings.safety).unwrap();
        let (task, plan) = NetworkPlan::load(&settings.task).unwrap();
        let model = PreshapeModel::load(&settings.model).unwrap();
        let world = |partner| {
            let own = Settings { partner, ..Settings::of_run(&settings, &task, limits.drive).unwrap() };
            World::new(&task, &robot, own).unwrap()
        };
        Self {
            world: world(Partner::Synthetic),
            live: world(Partner::Hand),
            perception: Perception::new(&task, &model).unwrap().with_robot(robot.clone()),
            network: Network::new(plan, task.fingerprint, 1).unwrap(),
            control: Control::new(robot, &task, &limits).unwrap(),
        }
    }

    /// Lends out the thread's stages. A panic leaves none behind.
    pub(crate) fn with<R>(use_them: impl FnOnce(&mut Self) -> R) -> R {
        let mut stages = STAGES.take().unwrap_or_else(Self::new);
        let result = use_them(&mut stages);
        STAGES.set(Some(stages));
        result
    }

    fn at(&mut self, instant: &Instant) {
        self.world.resume(&instant.state).unwrap();
        self.perception.resume(&instant.percept).unwrap();
        assert!(self.control.resume(&instant.command));
    }

    /// One period of what reads the messages of this instant, with these in the place of its own.
    fn step(&mut self, instant: &Instant, sample: &SensorSample, percept: &Percept, frame: &FieldFrame) {
        let tick = instant.tick + 1;
        let (mut next_percept, mut next_frame) = (instant.percept.clone(), instant.frame.clone());
        self.perception.step(tick, Some(sample), &mut next_percept);
        next_percept.header.cycle = tick;
        good(&*next_percept);
        self.network.step(tick, Some(percept), frame, &mut next_frame);
        next_frame.header.cycle = tick;
        good(&*next_frame);
        let mut command = instant.command.clone();
        self.control.step(tick, Some(sample), Some(percept), Some(frame), None, &mut command);
        command.header.cycle = tick;
        good(&*command);
        self.obey(instant, &command);
    }

    /// Some periods of the world of a person whose hand is told to be there.
    fn see(&mut self, instant: &Instant, hand: &HandPoints) {
        self.live.resume(&instant.state).unwrap();
        let Instant { sample, truth, state, .. } = instant;
        let (mut sample, mut truth, mut state) = (sample.clone(), truth.clone(), state.clone());
        for tick in instant.tick + 1..=instant.tick + SEEN {
            self.live.show_hand(&hand.position);
            self.live.step(tick, Some(&instant.command), &mut sample, &mut truth, &mut state);
            for header in [&mut sample.header, &mut truth.header, &mut state.header] {
                header.cycle = tick;
            }
            good(&*sample);
            good(&*truth);
            good(&*state);
        }
    }

    /// One period of the world with this command.
    fn obey(&mut self, instant: &Instant, command: &Command) {
        let tick = instant.tick + 1;
        let (mut sample, mut truth, mut state) =
            (instant.sample.clone(), instant.truth.clone(), instant.state.clone());
        self.world.step(tick, Some(command), &mut sample, &mut truth, &mut state);
        for header in [&mut sample.header, &mut truth.header, &mut state.header] {
            header.cycle = tick;
        }
        good(&*sample);
        good(&*truth);
        good(&*state);
    }
}

/// A stage that was given what is good sends what is good.
pub(crate) fn good<T: Plausible + Message>(message: &T) {
    assert_eq!(message.check(), Ok(()), "a stage sends what is not good");
}

/// The changed message of one of the instants, if a port would take it in behind the good one.
fn judged<T: Message>(
    bytes: &[u8],
    name: &str,
    of: impl Fn(&Instant) -> &T,
) -> Option<(&'static Instant, Box<T>)> {
    let instant = &INSTANTS[which(bytes, INSTANTS.len())];
    Some((instant, next_of(of(instant), instant.tick, bytes, name)?))
}

/// The same of a message that an instant has not.
fn next_of<T: Message>(original: &T, tick: u64, bytes: &[u8], name: &str) -> Option<Box<T>> {
    let mut next = *original.header();
    (next.cycle, next.sequence) = (next.cycle + 1, next.sequence + 1);
    let mut message = patched(original, &[]);
    *message.header_mut() = next;
    let message = patched(&*message, bytes);
    let time = (tick + 1, (tick + 1) * PERIOD_NS);
    let mut judge = Judge::of(name);
    let origin = Origin { publisher: 1, pid: 1 };
    let known = |generation, _| (generation == 0).then_some(Place::Stage);
    judge.judge(original.header(), origin, time, known).ok()?;
    judge.accept(original.header(), origin);
    judge.judge(message.header(), origin, time, known).ok()?;
    message.check().ok()?;
    Some(message)
}

pub(crate) fn sample(bytes: &[u8]) -> bool {
    let Some((instant, message)) = judged(bytes, topic::SENSORS, |instant| &*instant.sample) else {
        return false;
    };
    Stages::with(|stages| {
        stages.at(instant);
        stages.step(instant, &message, &instant.percept, &instant.frame);
    });
    Watch::with(|monitor| {
        monitor.sample(&message);
        monitor.joints(&message);
    });
    true
}

pub(crate) fn percept(bytes: &[u8]) -> bool {
    let Some((instant, message)) = judged(bytes, topic::PERCEPT, |instant| &*instant.percept) else {
        return false;
    };
    Stages::with(|stages| {
        stages.at(instant);
        stages.step(instant, &instant.sample, &message, &instant.frame);
    });
    true
}

pub(crate) fn frame(bytes: &[u8]) -> bool {
    let Some((instant, message)) = judged(bytes, topic::FIELDS, |instant| &*instant.frame) else {
        return false;
    };
    Stages::with(|stages| {
        stages.at(instant);
        // A frame of another task or network is integrated by nobody.
        if stages.network.fits(&message) {
            stages.step(instant, &instant.sample, &instant.percept, &message);
        }
        let mut command = instant.command.clone();
        stages.control.step(
            instant.tick + 1,
            Some(&instant.sample),
            None,
            Some(&message),
            None,
            &mut command,
        );
        Voice::new(task(), Meanings::from(stages.network.plan())).observe(&message);
    });
    Watch::with(|monitor| monitor.frame(&message, &mut Vec::new()));
    true
}

pub(crate) fn command(bytes: &[u8]) -> bool {
    let Some((instant, message)) = judged(bytes, topic::COMMAND, |instant| &*instant.command) else {
        return false;
    };
    Stages::with(|stages| {
        stages.at(instant);
        stages.obey(instant, &message);
    });
    Watch::with(|monitor| monitor.command(&message));
    true
}

pub(crate) fn truth(bytes: &[u8]) -> bool {
    let Some((instant, message)) = judged(bytes, topic::TRUTH, |instant| &*instant.truth) else {
        return false;
    };
    Watch::with(|monitor| {
        monitor.truth(&message, &mut Vec::new());
        monitor.frame(&instant.frame, &mut Vec::new());
        monitor.sample(&instant.sample);
    });
    true
}

pub(crate) fn world_state(bytes: &[u8]) -> bool {
    judged(bytes, topic::WORLD_STATE, |instant| &*instant.state).is_some()
}

pub(crate) fn speech(bytes: &[u8]) -> bool {
    let mut speech: Speech = bytemuck::Zeroable::zeroed();
    speech.header = INSTANTS[0].sample.header;
    speech.write("I will hold it steady, please insert the wheel.");
    let Some(speech) = next_of(&speech, INSTANTS[0].tick, bytes, topic::HEARD) else { return false };
    Stages::with(|stages| {
        stages.at(&INSTANTS[0]);
        stages.world.hear(speech.sentence());
        stages.obey(&INSTANTS[0], &INSTANTS[0].command);
    });
    Watch::with(|monitor| monitor.speech(&speech, &mut Vec::new()));
    true
}

/// A hand from outside, at a part of the person's.
pub(crate) fn hand(bytes: &[u8]) -> bool {
    let instant = &INSTANTS[0];
    let mut hand: HandPoints = bytemuck::Zeroable::zeroed();
    let points = HandModel::new(&task().scene).reaching(glam::DVec3::new(-0.98, 0.02, 0.81), -1.3, 0.1);
    (hand.header, hand.position) = (instant.sample.header, points.map(|point| point.to_array()));
    let Some(hand) = next_of(&hand, instant.tick, bytes, topic::HAND) else { return false };
    Stages::with(|stages| stages.see(instant, &hand));
    true
}

pub(crate) fn pulse(bytes: &[u8]) -> bool {
    let header = INSTANTS[1].command.header;
    let stamp = header.published_ns;
    let pulse = Pulse {
        header,
        released_ns: stamp - 900_000,
        scheduled_ns: stamp - 50_000,
        started_ns: stamp - 40_000,
        input_published_ns: stamp - 60_000,
        input_received_ns: stamp - 45_000,
        refused_topic: coact_messages::NONE,
        ..Pulse::default()
    };
    let name = topic::pulse("control");
    let Some(changed) = next_of(&pulse, INSTANTS[1].tick, bytes, &name) else { return false };
    Watch::with(|monitor| {
        monitor.pulse("control", &pulse);
        monitor.pulse("control", &changed);
    });
    true
}
