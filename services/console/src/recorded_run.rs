use crate::{Board, ConsoleSettings, Greeting, Machine, PictureMaker, Seen, Timeline, report};
use coact_joint_task::NetworkPlan;
use coact_messages::{Command, FieldFrame, Percept, SensorSample, Truth};
use coact_pipeline::Pipeline;
use coact_robot::Robot;
use coact_run_recording::{Recorded, Recording, RecordingError};
use coact_safety::SafetyLimits;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A run that is over, to be looked at: read from its recording, and from the logs beside it where they are.
pub struct RecordedRun {
    recording: Recording,
    board: Arc<Board>,
    maker: PictureMaker,
    timeline: Timeline,
    machine: Machine,
    newest: Newest,
    report: PathBuf,
}

/// The newest message of each sort that was read.
#[derive(Debug, Default)]
struct Newest {
    sample: Option<Box<SensorSample>>,
    percept: Option<Box<Percept>>,
    frame: Option<Box<FieldFrame>>,
    command: Option<Box<Command>>,
    truth: Option<Box<Truth>>,
}

/// From one glimpse that is shown to the next, cycles: the recorder keeps frames twice as often.
const SPACING: u64 = 100;

impl RecordedRun {
    /// Opens a recording; nothing of it is on the board yet.
    ///
    /// # Errors
    /// It is none, or what it was made of cannot be used.
    pub fn open(path: &Path, settings: &ConsoleSettings) -> anyhow::Result<Self> {
        let recording = Recording::open(path)?;
        let origin = recording.origin();
        let (maker, pipeline, safety) = origin.files.provided(|| -> anyhow::Result<_> {
            let (task, plan) = NetworkPlan::load(&origin.settings.task)?;
            let robot = Robot::load(&origin.settings.robot)?;
            let safety = SafetyLimits::load(&origin.settings.safety)?;
            let pipeline = Pipeline::of_run(&origin.settings)?;
            Ok((PictureMaker::new(task, plan, robot, &safety.person)?, pipeline, safety))
        })?;
        let report = path.parent().map(Path::to_owned).unwrap_or_default();
        let name = path.display().to_string();
        let greeting = Greeting {
            run: &name,
            settings: &origin.settings,
            pipeline: &pipeline,
            maker: &maker,
            recorded: true,
        };
        let board = Arc::new(Board::new(settings, greeting.to_json(), maker.plan().clone()));
        let timeline = Timeline::new(&report, maker.task(), maker.plan(), origin.start_ns);
        let machine = Machine::new(&pipeline, safety.stale.input_after);
        Ok(Self { recording, board, maker, timeline, machine, newest: Newest::default(), report })
    }

    /// Where it is shown.
    pub fn board(&self) -> Arc<Board> {
        Arc::clone(&self.board)
    }

    /// Reads it to its end, and puts it on the board; returns how many glimpses there are. A truncated one is read up to where it
    /// ends.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn read(mut self) -> Result<u64, RecordingError> {
        let (mut glimpses, mut due, mut cycle) = (0, 0, 0);
        while let Some(message) = self.recording.next_message()? {
            cycle = message.header().cycle.max(cycle);
            let is_sample = matches!(message, Recorded::Sample(_));
            self.take(message);
            if is_sample && cycle >= due {
                due = cycle + SPACING;
                glimpses += u64::from(self.show(cycle));
            }
        }
        if let Err(error) = self.timeline.read_logs() {
            tracing::warn!("{error}; what stands in that log is not shown");
        }
        self.board.put_events(self.timeline.events());
        self.board.put_machine(&self.machine.to_json(cycle));
        self.board.put_end(&report(&self.report, cycle, self.timeline.errors()));
        Ok(glimpses)
    }

    fn take(&mut self, message: Recorded) {
        let newest = &mut self.newest;
        match message {
            Recorded::Sample(sample) => newest.sample = Some(sample),
            Recorded::Percept(percept) => newest.percept = Some(percept),
            Recorded::Frame(frame) => newest.frame = Some(frame),
            Recorded::Command(command) => newest.command = Some(command),
            Recorded::Pulse { process, pulse } => self.machine.pulse(&process, &pulse),
            Recorded::Truth(truth) => newest.truth = Some(truth),
            Recorded::Speech(_) => (),
        }
    }

    /// Puts the present glimpse on the board, if there is anything to be seen.
    fn show(&mut self, cycle: u64) -> bool {
        let Self { newest, timeline, maker, board, machine, .. } = self;
        let seen = Seen {
            sample: newest.sample.as_deref(),
            percept: newest.percept.as_deref(),
            frame: newest.frame.as_deref(),
            command: newest.command.as_deref(),
            truth: newest.truth.as_deref(),
        };
        timeline.watch(&seen);
        let Some(glimpse) = maker.glimpse(&seen) else { return false };
        board.put_glimpse(glimpse);
        if cycle % 1000 < SPACING {
            board.put_events(timeline.events());
            board.put_machine(&machine.to_json(cycle));
        }
        true
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use bytemuck::zeroed_box;
    use coact_input_file::Files;
    use coact_messages::LAYOUT;
    use coact_pipeline::RunSettings;
    use coact_run_recording::{Origin, RecordingWriter};
    use std::collections::BTreeMap;

    const SETTINGS: ConsoleSettings =
        ConsoleSettings { port: 0, pictures_per_second: 30, pictures_kept: 100 };

    fn origin() -> Origin {
        let settings = RunSettings::shipped(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config"));
        let (_, files) = Files::noted(|| {
            NetworkPlan::load(&settings.task).unwrap();
            Robot::load(&settings.robot).unwrap();
            SafetyLimits::load(&settings.safety).unwrap();
            Pipeline::of_run(&settings).unwrap();
        });
        Origin { settings, files, ..Origin::default() }
    }

    /// Where the person's wrist truly is in the first glimpse of a recording of these messages.
    fn true_wrist(messages: &[Recorded]) -> [f32; 3] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.mcap");
        let mut writer = RecordingWriter::create(&path, &origin()).unwrap();
        messages.iter().for_each(|message| writer.message(message).unwrap());
        writer.finish(&BTreeMap::new()).unwrap();
        let run = RecordedRun::open(&path, &SETTINGS).unwrap();
        let (board, before) = (run.board(), run.maker.numbers_before_truth());
        assert_eq!(run.read().unwrap(), 1);
        let glimpse = board.at(0).unwrap();
        let number = |index: usize| {
            let bytes = &glimpse.picture.bytes[16 + 4 * index..][..4];
            f32::from_le_bytes(bytes.try_into().unwrap())
        };
        std::array::from_fn(|axis| number(before + 2 * 3 + axis))
    }

    #[test]
    fn the_truth_is_shown_where_it_was_recorded_and_an_older_recording_opens_without_it() {
        let (mut sample, mut truth) = (zeroed_box::<SensorSample>(), zeroed_box::<Truth>());
        (sample.header.layout, truth.header.layout) = (LAYOUT, LAYOUT);
        truth.arms[0][2] = [-0.75, 0.25, 1.0];
        let [sample, truth] = [Recorded::Sample(sample), Recorded::Truth(truth)];
        assert_eq!(true_wrist(&[truth, sample.clone()]), [-0.75, 0.25, 1.0]);
        assert!(true_wrist(&[sample]).iter().all(|number| number.is_nan()));
    }
}
