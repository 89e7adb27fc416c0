use crate::Sources;
use crate::foxglove::{JointStates, RunLogs, Scene, Transforms};
use crate::queue::{Item, QueueOut};
use coact_messages::SensorSample;
use coact_realtime::now;
use coact_run_recording::{Origin, Recorded, RecordingError, RecordingWriter};
use std::time::{Duration, Instant};

/// How often what was written is handed to the system: a kill loses no more than that.
const FLUSH_EVERY: Duration = Duration::from_secs(1);
/// How long it waits for a message before it looks at the time. Chosen by hand; not sensitive.
const WAIT: Duration = Duration::from_millis(100);

/// Writes what comes out of the queue into the file, with what Foxglove shows of it.
pub(crate) struct Storage {
    writer: RecordingWriter,
    transforms: Transforms,
    joints: JointStates,
    scene: Scene,
    logs: RunLogs,
    scene_every: u64,
    scene_due: u64,
    written: u64,
}

impl Storage {
    pub fn new(writer: RecordingWriter, origin: &Origin, sources: &Sources) -> Self {
        let Sources { task, robot, own, .. } = sources;
        Self {
            writer,
            transforms: Transforms::new(robot.clone()),
            joints: JointStates::new(robot),
            scene: Scene::new(robot.clone(), task),
            logs: RunLogs::new(&origin.settings.report),
            scene_every: own.scene_every,
            scene_due: 0,
            written: 0,
        }
    }

    /// Writes until the end comes; returns how many messages that were.
    ///
    /// # Errors
    /// The file cannot be written: nothing more is.
    pub fn run(mut self, queue: &QueueOut) -> Result<u64, RecordingError> {
        let mut flushed = Instant::now();
        while let Ok(item) = queue.take(WAIT) {
            match item {
                Some(Item::Message(message)) => self.message(&message)?,
                Some(Item::End(lost)) => {
                    self.follow_logs()?;
                    self.writer.finish(&lost)?;
                    return Ok(self.written);
                }
                None => {}
            }
            if flushed.elapsed() >= FLUSH_EVERY {
                flushed = Instant::now();
                self.follow_logs()?;
                self.writer.flush()?;
            }
        }
        Ok(self.written)
    }

    fn message(&mut self, message: &Recorded) -> Result<(), RecordingError> {
        self.writer.message(message)?;
        self.written += 1;
        if let Some((who, sentence)) = self.logs.sentence(message) {
            self.log(message.header().published_ns, who, &sentence)?;
        }
        match message {
            Recorded::Sample(sample) if sample.header.cycle >= self.scene_due => {
                self.scene_due = sample.header.cycle + self.scene_every;
                self.show(sample)
            }
            _ => Ok(()),
        }
    }

    fn show(&mut self, sample: &SensorSample) -> Result<(), RecordingError> {
        let Self { writer, transforms, joints, scene, .. } = self;
        let at_ns = sample.header.published_ns;
        let ns = at_ns + writer.clock_offset_ns();
        writer.json(Transforms::TOPIC, &transforms.schema, at_ns, &transforms.of(sample, ns))?;
        writer.json(JointStates::TOPIC, &joints.schema, at_ns, &joints.of(sample, ns))?;
        writer.json(Scene::TOPIC, &scene.schema, at_ns, &scene.of(sample, ns))
    }

    fn follow_logs(&mut self) -> Result<(), RecordingError> {
        let at_ns = now();
        self.logs.news().iter().try_for_each(|(who, line)| self.log(at_ns, who, line))
    }

    fn log(&mut self, at_ns: u64, who: &str, text: &str) -> Result<(), RecordingError> {
        let line = RunLogs::line(at_ns + self.writer.clock_offset_ns(), who, text);
        self.writer.json(RunLogs::TOPIC, &self.logs.schema, at_ns, &line)
    }
}
