use crate::holdings::Holdings;
use crate::sightings::Sightings;
use crate::{Journal, JournalError, Moment};
use coact_joint_task::Task;
use coact_messages::{Command, NONE, PERSON, ROBOT, SensorSample, Truth};
use std::path::Path;

/// `album.jsonl`: a run in moments, one for every part that changed hands or came into its place.
///
/// Where everything is, is what the sensors say; what is in a hand or in its place, and what the person is at, is true.
#[derive(Debug)]
pub struct Album {
    task: Task,
    journal: Journal<Moment>,
    sample: Option<Box<SensorSample>>,
    sightings: Sightings,
    /// Action that the robot carries out: index into the task's.
    action: u32,
    /// Chain that the person carries out, likewise.
    chain: u32,
    holdings: Holdings,
    /// Those that were looked at last.
    told: Option<Holdings>,
}

/// The first moment is taken once the cameras have delivered, cycles.
const SETTLED: u64 = 200;
/// An album that holds so many moments takes down the end only: those of some forty assemblies.
const FULL: usize = 1000;

impl Album {
    /// Name of the file in the report directory.
    pub const FILE: &'static str = "album.jsonl";

    /// Opens the album of a report, and goes on with what it holds.
    ///
    /// # Errors
    /// The file cannot be read or written, or holds something else.
    pub fn open(report: &Path, task: &Task) -> Result<Self, JournalError> {
        let journal = Journal::open(&report.join(Self::FILE))?;
        Ok(Self {
            task: task.clone(),
            journal,
            sample: None,
            sightings: Sightings::default(),
            action: NONE,
            chain: NONE,
            holdings: Holdings::default(),
            told: None,
        })
    }

    /// Reads the album of a run that has ended.
    ///
    /// # Errors
    /// There is none, or it is damaged.
    pub fn read(report: &Path) -> Result<Vec<Moment>, JournalError> {
        Journal::read(&report.join(Self::FILE))
    }

    /// What the sensors say.
    pub fn sample(&mut self, sample: &SensorSample) {
        self.sightings.see(&sample.scene, &self.task);
        match &mut self.sample {
            Some(newest) => **newest = *sample,
            None => self.sample = Some(Box::new(*sample)),
        }
    }

    /// What the arm was told to do.
    pub fn command(&mut self, command: &Command) {
        self.action = command.action;
    }

    /// What is true.
    pub fn truth(&mut self, truth: &Truth) {
        self.chain = truth.chain;
        self.holdings = truth.into();
    }

    /// Takes down the moment if something has changed since the last look.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn look(&mut self) -> std::io::Result<()> {
        if self.sample.as_ref().is_none_or(|sample| sample.header.cycle < SETTLED) {
            return Ok(());
        }
        let now = self.holdings;
        let news = match self.told.replace(now) {
            Some(before) => now.news_since(&before, &self.task),
            None => self.journal.entries().is_empty().then(|| "the beginning".into()),
        };
        match news {
            Some(what) if self.journal.entries().len() < FULL => self.take_down(what),
            _ => Ok(()),
        }
    }

    /// Takes down the last moment.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn finish(&mut self) -> std::io::Result<()> {
        self.take_down("the end".into())
    }

    fn take_down(&mut self, what: String) -> std::io::Result<()> {
        let Some(sample) = &self.sample else { return Ok(()) };
        let (task, holdings) = (&self.task, &self.holdings);
        let chain = task.chains.get(self.chain as usize);
        let moment = Moment {
            at_ms: sample.header.cycle,
            what,
            robot_does: task.actions.get(self.action as usize).map(|action| action.name.clone()),
            person_does: chain.map(|chain| format!("{}: {}", chain.name, task.kinds[chain.kind].name)),
            robot_holds: holdings.held_by(ROBOT, task),
            person_holds: holdings.held_by(PERSON, task),
            in_place: holdings.names_in_place(task),
            joints: sample.joints.position,
            parts: self.sightings.parts(task),
            keypoints: sample.hand.keypoints.map(|point| (point.confidence > 0.0).then_some(point.position)),
        };
        self.journal.append(vec![moment])
    }
}
