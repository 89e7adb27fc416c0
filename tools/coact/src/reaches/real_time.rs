//! The same reaches through the process set, at 1 kHz.

use crate::installation::Installation;
use anyhow::{Context, Result, bail};
use coact_messages::{FieldFrame, Percept, topic};
use coact_pipeline::{Pipeline, Run, RunSettings, WorldMode};
use coact_reaches::{Course, Evaluation, Outcome, Subject};
use coact_realtime::{Bus, Input, PortError};
use coact_supervisor::{Ending, Launch};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// How long the set goes on after the last reach.
const AFTERGLOW: Duration = Duration::from_millis(200);
/// How often the topics are looked at: a reader of the chain's topics sees the newest message only.
const LOOK_EVERY: Duration = Duration::from_micros(500);

/// How the process set fared with one subject.
#[derive(Debug, Clone, Serialize)]
pub struct Regularity {
    /// Number of the person.
    pub participant: u32,
    /// Cycles of the chain, of which the looker-on saw so many frames.
    pub cycles: u64,
    /// Frames that were seen.
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
    pub fn play(&self, subject: &Subject) -> Result<(Vec<Outcome>, Regularity)> {
        let report = self.report.join(format!("p{}", subject.participant));
        std::fs::create_dir_all(&report).with_context(|| report.display().to_string())?;
        let model = report.join("preshape.toml");
        let text = toml::to_string(&subject.model)?;
        std::fs::write(&model, format!("# What was known of other people than this one.\n\n{text}"))
            .with_context(|| model.display().to_string())?;
        let launch = self.launch(subject, model, &report)?;
        let plan = self.evaluation.plan;
        let (ending, seen) = launch.run_beside(|run, over| {
            let mut seen = Seen::default();
            seen.look_on(run, over, |course, frame| course.frame(plan, frame)).map(|()| seen)
        })?;
        if ending == Ending::Interrupted {
            bail!("interrupted");
        }
        let seen = seen?;
        let regularity = regularity(subject.participant, seen.frames, report)?;
        Ok((seen.course.judge(self.evaluation.task, &subject.replay), regularity))
    }

    fn launch(&self, subject: &Subject, model: PathBuf, report: &Path) -> Result<Launch> {
        let below = |path: &str| self.installation.configuration.join(path);
        let folder = std::path::absolute(self.recordings)?;
        let last = subject.replay.spans().last().map_or(0, |span| span.end);
        let settings = RunSettings {
            task: std::path::absolute(self.task)?,
            robot: below("robots/aros.toml"),
            model: std::path::absolute(model)?,
            pipeline: below("pipeline.toml"),
            report: std::path::absolute(report)?,
            seed: self.evaluation.seed,
            partner: format!("replay:{}:{}", subject.participant, folder.display()),
            world: WorldMode::Kinematic,
        };
        Ok(Launch {
            pipeline: Pipeline::load(&settings.pipeline)?,
            settings,
            task: self.evaluation.task.clone(),
            programs: self.installation.programs.clone(),
            duration: Some(Duration::from_millis(last) + AFTERGLOW),
            injections: Vec::new(),
        })
    }
}

/// What the looker-on saw.
#[derive(Default)]
struct Seen {
    course: Course,
    frames: u64,
}

impl Seen {
    fn look_on(
        &mut self,
        run: &Run,
        over: &AtomicBool,
        take_down: impl Fn(&mut Course, &FieldFrame),
    ) -> Result<(), PortError> {
        let bus = Bus::open(run, "reaches", 0)?;
        let mut percepts: Input<Percept> = bus.input(topic::PERCEPT)?;
        let mut frames: Input<FieldFrame> = bus.input(topic::FIELDS)?;
        while !over.load(Ordering::Relaxed) {
            std::thread::sleep(LOOK_EVERY);
            percepts.each(|percept| self.course.percept(percept))?;
            frames.each(|frame| {
                take_down(&mut self.course, frame);
                self.frames += 1;
            })?;
        }
        Ok(())
    }
}

/// Reads it from the run's own report.
fn regularity(participant: u32, frames_seen: u64, report: PathBuf) -> Result<Regularity> {
    let path = report.join("summary.json");
    let text = std::fs::read_to_string(&path).with_context(|| path.display().to_string())?;
    let summary: serde_json::Value =
        serde_json::from_str(&text).with_context(|| path.display().to_string())?;
    let processes = summary["processes"].as_object().into_iter().flatten();
    Ok(Regularity {
        participant,
        cycles: summary["processes"]["fields"]["cycles"].as_u64().unwrap_or(0),
        frames_seen,
        missed: processes.filter_map(|(_, process)| process["missed"].as_u64()).sum(),
        end_to_end_p99_ns: summary["end_to_end_ns"]["p99"].as_u64().unwrap_or(0),
        report,
    })
}
