//! Whatever happened to the stages in real time, the replay computes what they computed; what it cannot know, it says.
#![allow(clippy::unwrap_used)]

use coact_fields::Network;
use coact_input_file::{Files, read_text};
use coact_joint_task::NetworkPlan;
use coact_lockstep::Lockstep;
use coact_messages::{FieldFrame, Header, LAYOUT, Percept, Pulse, SensorSample};
use coact_perception::{Perception, PreshapeModel};
use coact_period::PERIOD_NS;
use coact_pipeline::{RunSettings, WorldMode};
use coact_replay::{ReplayError, ReplayReport, replay};
use coact_robot::Robot;
use coact_run_recording::{Origin, Recorded, RecordingWriter};
use std::path::Path;

/// Cycles of each run: the person reaches, and the first decision is made.
const CYCLES: u64 = 2500;
/// One field frame in so many is recorded.
const FRAMES_EVERY: u64 = 50;

fn settings() -> RunSettings {
    let configuration = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    RunSettings { world: WorldMode::Kinematic, ..RunSettings::shipped(&configuration) }
}

/// A run whose stages are not always on time, with all that it would leave in a recording.
struct Run {
    world: Lockstep,
    perception: Perception,
    fresh: Perception,
    network: Network,
    sample: Box<SensorSample>,
    percept: Box<Percept>,
    frame: Box<FieldFrame>,
    generation: u32,
    sequences: [u64; 2],
    recorded: Vec<Recorded>,
}

/// What happens in a cycle.
#[derive(Clone, Copy, Default)]
struct Cycle {
    perception_skips: bool,
    sample_is_late: bool,
    percept_is_late: bool,
    perception_is_replaced: bool,
}

impl Run {
    fn new() -> Self {
        let settings = settings();
        let (task, plan) = NetworkPlan::load(&settings.task).unwrap();
        let (robot, model) =
            (Robot::load(&settings.robot).unwrap(), PreshapeModel::load(&settings.model).unwrap());
        let perception = Perception::new(&task, &model).unwrap().with_robot(robot);
        let network = Network::new(plan, task.fingerprint, settings.seed).unwrap();
        let mut frame = bytemuck::zeroed_box();
        network.rest(&mut frame);
        Self {
            world: Lockstep::new(&settings).unwrap(),
            fresh: perception.clone(),
            perception,
            network,
            sample: bytemuck::zeroed_box(),
            percept: bytemuck::zeroed_box(),
            frame,
            generation: 0,
            sequences: [0; 2],
            recorded: Vec::new(),
        }
    }

    fn step(&mut self, happens: Cycle) {
        let cycle = self.world.ticks();
        self.world.step();
        let late = self.sample.clone();
        self.sample = self.world.sample.clone();
        self.sample.header = header(cycle, cycle, 0, cycle * PERIOD_NS + 1, 0);
        self.recorded.push(Recorded::Sample(self.sample.clone()));
        let before = self.percept.clone();
        if !happens.perception_skips {
            self.perceive(cycle, happens, &late);
        }
        let given = if happens.percept_is_late { before } else { self.percept.clone() };
        self.integrate(cycle, &given);
    }

    fn perceive(&mut self, cycle: u64, happens: Cycle, late: &SensorSample) {
        if happens.perception_is_replaced {
            self.generation += 1;
            self.perception = self.fresh.clone();
            self.perception.resume(&self.percept).unwrap();
        }
        let sample = if happens.sample_is_late { late } else { &self.sample };
        self.perception.step(cycle, Some(sample), &mut self.percept);
        let sensor_ns = sample.header.sensor_ns;
        self.percept.header =
            header(cycle, self.sequences[0], sensor_ns, cycle * PERIOD_NS + 2, self.generation);
        self.sequences[0] += 1;
        self.recorded.push(pulse("perception", &self.percept.header, &sample.header));
        self.recorded.push(Recorded::Percept(self.percept.clone()));
    }

    fn integrate(&mut self, cycle: u64, percept: &Percept) {
        let previous = self.frame.clone();
        self.network.step(cycle, Some(percept), &previous, &mut self.frame);
        let sensor_ns = percept.header.sensor_ns;
        self.frame.header = header(cycle, self.sequences[1], sensor_ns, cycle * PERIOD_NS + 3, 0);
        self.sequences[1] += 1;
        self.recorded.push(pulse("fields", &self.frame.header, &percept.header));
        if cycle.is_multiple_of(FRAMES_EVERY) {
            self.recorded.push(Recorded::Frame(self.frame.clone()));
        }
    }

    /// A whole run.
    fn of(happens: impl Fn(u64) -> Cycle) -> Vec<Recorded> {
        let mut run = Self::new();
        // The first cycle has an input: nothing is late yet.
        (0..CYCLES).for_each(|cycle| run.step(if cycle == 0 { Cycle::default() } else { happens(cycle) }));
        run.recorded
    }
}

fn header(cycle: u64, sequence: u64, sensor_ns: u64, published_ns: u64, generation: u32) -> Header {
    let sensor_ns = if sensor_ns == 0 { published_ns } else { sensor_ns };
    Header { layout: LAYOUT, generation, sequence, cycle, sensor_ns, published_ns, reserved: 0 }
}

fn pulse(process: &str, header: &Header, input: &Header) -> Recorded {
    let pulse = Pulse { header: *header, input_published_ns: input.published_ns, ..Pulse::default() };
    Recorded::Pulse { process: process.to_owned(), pulse: Box::new(pulse) }
}

fn replayed(recorded: &[Recorded]) -> Result<ReplayReport, ReplayError> {
    let settings = settings();
    let ((), files) = Files::noted(|| {
        NetworkPlan::load(&settings.task).unwrap();
        Robot::load(&settings.robot).unwrap();
        read_text(&settings.model).unwrap();
    });
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.mcap");
    let mut writer =
        RecordingWriter::create(&path, &Origin { settings, files, ..Origin::default() }).unwrap();
    recorded.iter().for_each(|message| writer.message(message).unwrap());
    writer.finish(&[].into()).unwrap();
    replay(&path)
}

#[test]
fn late_inputs_skipped_cycles_and_replacements_are_computed_as_they_were() {
    let recorded = Run::of(|cycle| Cycle {
        perception_skips: cycle % 7 == 3,
        sample_is_late: cycle % 11 == 5,
        percept_is_late: cycle % 13 == 6,
        perception_is_replaced: cycle % 500 == 401,
    });
    let report = replayed(&recorded).unwrap();
    assert!(report.equal, "{report:?}");
    let skipped = (1..CYCLES).filter(|cycle| cycle % 7 == 3).count() as u64;
    assert_eq!((report.percepts.compared, report.percepts.not_compared), (CYCLES - skipped, 0));
    assert_eq!((report.frames.compared, report.frames.computed), (CYCLES / FRAMES_EVERY, CYCLES));
    assert!(report.decisions >= 1 && !report.same_code, "{report:?}");
}

#[test]
fn a_standby_s_account_of_its_stage_s_frame_misleads_nobody() {
    let recorded = Run::of(|cycle| Cycle { percept_is_late: cycle % 5 == 2, ..Cycle::default() });
    // The standby waits on the newest percept while its stage sends a frame that was computed on the one before.
    let with_standby = recorded.into_iter().flat_map(|message| {
        let standby = match &message {
            Recorded::Pulse { process, pulse } if process == "fields" => {
                let newest = Header { published_ns: pulse.header.cycle * PERIOD_NS + 2, ..pulse.header };
                Some(self::pulse("fields-standby", &pulse.header, &newest))
            }
            _ => None,
        };
        standby.into_iter().chain([message])
    });
    let report = replayed(&with_standby.collect::<Vec<_>>()).unwrap();
    assert!(report.equal && report.frames.computed == CYCLES, "{report:?}");
}

#[test]
fn the_first_message_that_differs_is_named_by_its_cycle_and_field() {
    let mut recorded = Run::of(|_| Cycle::default());
    for message in &mut recorded {
        match message {
            Recorded::Percept(percept) if percept.header.cycle == 1200 => {
                percept.arms[0].wrist.velocity[1] += 1e-9
            }
            Recorded::Frame(frame) if frame.header.cycle == 2000 => frame.decision.since ^= 1,
            _ => {}
        }
    }
    let report = replayed(&recorded).unwrap();
    assert_eq!((report.equal, report.percepts.differing, report.frames.differing), (false, 1, 1));
    let found = [&report.percepts, &report.frames].map(|stage| stage.first_difference.clone().unwrap());
    assert_eq!((found[0].cycle, found[0].field.as_str()), (1200, "arms[0].wrist.velocity[1]"));
    assert_eq!((found[1].cycle, found[1].field.as_str()), (2000, "decision.since"));
}

#[test]
fn where_samples_or_pulses_are_lost_stages_go_on_from_their_next_recorded_message() {
    let mut recorded = Run::of(|_| Cycle::default());
    recorded.retain(|message| {
        let cycle = message.header().cycle;
        match message {
            Recorded::Sample(_) => !(1000..1010).contains(&cycle),
            // A pulse alone is no loss: the percept itself says on which sample it was computed.
            Recorded::Pulse { process, .. } => process != "perception" || !(1500..1600).contains(&cycle),
            _ => true,
        }
    });
    let report = replayed(&recorded).unwrap();
    assert!(report.equal, "{report:?}");
    assert_eq!((report.percepts.not_compared, report.percepts.resumed), (10, 10));
    assert_eq!((report.percepts.compared, report.frames.compared), (CYCLES - 10, CYCLES / FRAMES_EVERY));
}

#[test]
fn a_recording_that_begins_in_the_middle_goes_on_from_its_first_messages() {
    let mut recorded = Run::of(|_| Cycle::default());
    recorded.retain(|message| message.header().cycle >= 777);
    let report = replayed(&recorded).unwrap();
    assert!(report.equal, "{report:?}");
    assert_eq!((report.percepts.compared, report.percepts.resumed), (CYCLES - 778, 1));
    assert_eq!((report.frames.resumed, report.frames.compared), (1, CYCLES / FRAMES_EVERY - 17));
}

#[test]
fn a_recording_without_anything_to_compare_is_refused() {
    let mut recorded = Run::of(|_| Cycle::default());
    recorded.retain(|message| matches!(message, Recorded::Sample(_)));
    let refused = replayed(&recorded).unwrap_err().to_string();
    assert!(refused.contains("holds nothing that can be compared"), "{refused}");
}
