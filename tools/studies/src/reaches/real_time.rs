//! The same reaches through the process set, at 1 kHz.

use anyhow::{Context, Result, bail};
use coact::installation::Installation;
use coact_joint_task::NetworkPlan;
use coact_messages::{FieldFrame, Percept, topic};
use coact_period::PERIOD;
use coact_pipeline::{Pipeline, Run, RunSettings, WorldMode};
use coact_reaches::{Evaluation, InferenceTrace, ReachOutcome, Subject};
use coact_realtime::{Bus, Input, PortError};
use coact_run_records::Summary;
use coact_supervisor::{Ending, Launch};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// How long the process set goes on after the last reach: until its last messages have been read. Chosen by hand; not sensitive.
const AFTER_LAST_REACH: Duration = Duration::from_millis(200);
/// How often the topics are read: a reader of the chain's topics sees the newest message only, so twice a period.
const LOOK_EVERY: Duration = Duration::from_micros(500);

/// How the process set fared with one subject.
#[derive(Debug, Clone, Serialize)]
pub struct RealTimeMetrics {
    /// Number of the person.
    pub participant: u32,
    /// Cycles of the chain.
    pub cycles: u64,
    /// Field frames that were read of them.
    pub frames_seen: u64,
    /// Cycles of all processes that missed their deadline.
    pub missed: u64,
    /// Sensor to command, ns: 99th percentile.
    pub end_to_end_p99_ns: u64,
    /// The run's report.
    pub report: PathBuf,
}

/// Plays reaches to the process set.
pub struct RealTime<'a> {
    pub installation: &'a Installation,
    pub evaluation: Evaluation<'a>,
    pub task: &'a Path,
    pub recordings: &'a Path,
    /// Each subject's run gets a folder below it.
    pub report: &'a Path,
}

impl RealTime<'_> {
    /// Plays one subject's reaches, and judges what was decided.
    pub fn play(&self, subject: &Subject) -> Result<(Vec<ReachOutcome>, RealTimeMetrics)> {
        let report = self.report.join(format!("p{}", subject.participant));
        std::fs::create_dir_all(&report).with_context(|| report.display().to_string())?;
        let model = report.join("preshape.toml");
        let text = toml::to_string(&subject.model)?;
        std::fs::write(&model, format!("# The model of preshaping that the other people make.\n\n{text}"))
            .with_context(|| model.display().to_string())?;
        let launch = self.launch(subject, model, &report)?;
        let plan = self.evaluation.plan;
        let (ending, observer) = launch.run_with_observer(|run, over| {
            let mut observer = Observer::default();
            observer.observe(run, over, plan).map(|()| observer)
        })?;
        if ending == Ending::Interrupted {
            bail!("interrupted");
        }
        let observer = observer?;
        let metrics = metrics(subject.participant, observer.frames, report)?;
        Ok((observer.trace.judge(self.evaluation.task, &subject.replay), metrics))
    }

    fn launch(&self, subject: &Subject, model: PathBuf, report: &Path) -> Result<Launch> {
        let folder = std::path::absolute(self.recordings)?;
        let last = subject.replay.spans().last().map_or(0, |span| span.end);
        let settings = RunSettings {
            task: std::path::absolute(self.task)?,
            model: std::path::absolute(model)?,
            report: std::path::absolute(report)?,
            seed: self.evaluation.seed,
            partner: format!("replay:{}:{}", subject.participant, folder.display()),
            world: WorldMode::Kinematic,
            duration: Some(PERIOD * last as u32 + AFTER_LAST_REACH),
            ..RunSettings::shipped(&self.installation.configuration)
        };
        Ok(Launch {
            pipeline: Pipeline::of_run(&settings)?,
            settings,
            task: self.evaluation.task.clone(),
            programs: self.installation.programs.clone(),
            injections: Vec::new(),
        })
    }
}

/// Records what perception and the fields publish.
#[derive(Default)]
struct Observer {
    trace: InferenceTrace,
    frames: u64,
}

impl Observer {
    /// Records until the run is `over`, for the network that `plan` describes.
    fn observe(&mut self, run: &Run, over: &AtomicBool, plan: &NetworkPlan) -> Result<(), PortError> {
        let bus = Bus::open(run, "reaches", 0)?;
        let mut percepts: Input<Percept> = bus.input(topic::PERCEPT)?;
        let mut frames: Input<FieldFrame> = bus.input(topic::FIELDS)?;
        while !over.load(Ordering::Relaxed) {
            std::thread::sleep(LOOK_EVERY);
            percepts.each(|percept| self.trace.percept(percept))?;
            frames.each(|frame| {
                self.trace.frame(plan, frame);
                self.frames += 1;
            })?;
        }
        Ok(())
    }
}

/// Reads them from the run's own report.
fn metrics(participant: u32, frames_seen: u64, report: PathBuf) -> Result<RealTimeMetrics> {
    let summary = Summary::read(&report)?;
    Ok(RealTimeMetrics {
        participant,
        cycles: summary.processes.get("fields").map_or(0, |fields| fields.cycles),
        frames_seen,
        missed: summary.processes.values().map(|process| process.missed).sum(),
        end_to_end_p99_ns: summary.end_to_end_ns.p99,
        report,
    })
}
