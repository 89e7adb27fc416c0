use crate::part_locations::PartLocations;
use crate::recognised_parts::RecognisedParts;
use coact_joint_task::Task;
use coact_messages::{Command, NONE, PERSON, ROBOT, SensorSample, Truth};
use coact_period::cycles;
use coact_run_records::{RecordError, RunLog, Snapshot};
use std::path::Path;
use std::time::Duration;

/// Writes the snapshot log: a [`Snapshot`] for every part that changed hands or came into its place.
///
/// Positions are those that the sensors saw. What is in a hand or in its place, and what the person does, is from
/// [`Truth`].
#[derive(Debug)]
pub struct SnapshotLog {
    task: Task,
    log: RunLog<Snapshot>,
    sample: Option<Box<SensorSample>>,
    parts: RecognisedParts,
    /// Action that the robot carries out: index into the task's.
    action: u32,
    /// Chain that the person carries out, likewise.
    chain: u32,
    locations: PartLocations,
    /// Those of the last look.
    looked_at: Option<PartLocations>,
}

/// The cycle of the first snapshot: every camera has delivered frames by then.
const SETTLED: u64 = cycles(Duration::from_millis(200));
/// A log of so many snapshots gets only the last one of the run in addition. They are those of some forty assemblies, more
/// than a sheet of pictures can show, and take about 1 MB.
const FULL: usize = 1000;

impl SnapshotLog {
    /// Opens the log of a report directory, and goes on with what is in it.
    ///
    /// # Errors
    /// The file cannot be read or written, or holds something else.
    pub fn open(report: &Path, task: &Task) -> Result<Self, RecordError> {
        Ok(Self {
            task: task.clone(),
            log: RunLog::open(report)?,
            sample: None,
            parts: RecognisedParts::default(),
            action: NONE,
            chain: NONE,
            locations: PartLocations::default(),
            looked_at: None,
        })
    }

    /// What the sensors say.
    pub fn sample(&mut self, sample: &SensorSample) {
        self.parts.add_frame(&sample.scene, &self.task);
        match &mut self.sample {
            Some(newest) => **newest = *sample,
            None => self.sample = Some(Box::new(*sample)),
        }
    }

    /// What the arm shall do.
    pub fn command(&mut self, command: &Command) {
        self.action = command.action;
    }

    /// What is in which hand and place.
    pub fn truth(&mut self, truth: &Truth) {
        self.chain = truth.chain;
        self.locations = truth.into();
    }

    /// Writes a snapshot if a part has changed its place since the last look.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn look(&mut self) -> Result<(), RecordError> {
        if self.sample.as_ref().is_none_or(|sample| sample.header.cycle < SETTLED) {
            return Ok(());
        }
        let now = self.locations;
        let changes = match self.looked_at.replace(now) {
            Some(before) => now.changes_since(&before, &self.task),
            None => self.log.records().is_empty().then(|| "the beginning".into()),
        };
        match changes {
            Some(what) if self.log.records().len() < FULL => self.append(what),
            _ => Ok(()),
        }
    }

    /// Writes the last snapshot of the run.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn finish(&mut self) -> Result<(), RecordError> {
        self.append("the end".into())
    }

    fn append(&mut self, what: String) -> Result<(), RecordError> {
        let Some(sample) = &self.sample else { return Ok(()) };
        let (task, locations) = (&self.task, &self.locations);
        let chain = task.chains.get(self.chain as usize);
        let snapshot = Snapshot {
            at_ms: sample.header.cycle,
            what,
            robot_does: task.actions.get(self.action as usize).map(|action| action.name.clone()),
            person_does: chain.map(|chain| format!("{}: {}", chain.name, task.kinds[chain.kind].name)),
            robot_holds: locations.held_by(ROBOT, task),
            person_holds: locations.held_by(PERSON, task),
            in_place: locations.names_in_place(task),
            joints: sample.joints.position,
            parts: self.parts.parts(task),
            keypoints: sample
                .hands
                .map(|hand| hand.keypoints.map(|point| (point.confidence > 0.0).then_some(point.position))),
        };
        self.log.append(vec![snapshot])
    }
}
