use crate::{Lockstep, LockstepError};
use coact_messages::{ARM_JOINTS, Header, Speech};
use coact_monitor::{Intentions, Monitor, MonitorError, Rules, RulesError, Watched, environment};
use coact_period::{PERIOD_NS, cycles};
use coact_pipeline::RunSettings;
use coact_robot::{Robot, RobotError};
use coact_run_records::Summary;
use coact_safety::{SafetyError, SafetyLimits};
use coact_voice::{Meanings, Sentence, Standstill, Voice};
use std::time::{Duration, Instant, SystemTime};

/// How often monitor and voice look at the messages: as their processes do.
const LOOK_EVERY: u64 = cycles(Duration::from_millis(5));
/// How long a run without a duration goes on when nothing is completed: some five times as long as the toy vehicle takes.
const LONGEST: Duration = Duration::from_secs(300);
/// How long it goes on after completion: until the last sentence has been said. Chosen by hand.
const AFTER_COMPLETION: u64 = cycles(Duration::from_secs(2));

/// A run that has come to its end.
pub struct FinishedRun {
    /// What went into `summary.json`.
    pub summary: Summary,
    /// Cycles of the run's own time.
    pub ticks: u64,
    /// How long they took to compute.
    pub elapsed: Duration,
}

/// Why a run came to no end.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "each variant is the error of what it names")]
pub enum RunError {
    #[error(transparent)]
    Stage(#[from] LockstepError),
    #[error(transparent)]
    Monitor(#[from] MonitorError),
    #[error(transparent)]
    Rules(#[from] RulesError),
    #[error(transparent)]
    Robot(#[from] RobotError),
    #[error(transparent)]
    Safety(#[from] SafetyError),
    #[error("{path}: {cause}; expected a folder that can be written to")]
    Report { path: std::path::PathBuf, cause: std::io::Error },
}

/// Runs all stages for `duration`, or, without one, until every subgoal is achieved (300 s at most), and writes the
/// report of the settings. `progress` is told of every look: the tick, and what was said since the last one.
///
/// # Errors
/// A file or setting that is refused, or a report that cannot be written.
pub fn run(
    settings: &RunSettings,
    duration: Option<Duration>,
    mut progress: impl FnMut(&Lockstep, Option<&Sentence>),
) -> Result<FinishedRun, RunError> {
    let mut stages = Lockstep::new(settings)?;
    std::fs::create_dir_all(&settings.report)
        .map_err(|cause| RunError::Report { path: settings.report.clone(), cause })?;
    let mut monitor = monitor(settings, &stages)?;
    let (mut voice, mut standstill) =
        (Voice::new(stages.task(), Meanings::from(stages.plan())), Standstill::default());
    let most = (duration.unwrap_or(LONGEST).as_nanos() / u128::from(PERIOD_NS)) as u64;
    let (started, mut end) = (Instant::now(), most);
    let mut events = Vec::new();
    while stages.ticks() < end {
        stages.step();
        monitor.truth(&stages.truth, &mut events);
        monitor.joints(&stages.sample);
        if stages.ticks() % LOOK_EVERY != 0 {
            continue;
        }
        monitor.sample(&stages.sample);
        monitor.frame(&stages.frame, &mut events);
        monitor.command(&stages.command);
        let decided = voice.observe(&stages.frame);
        let sentence = decided.or_else(|| standstill.observe(&stages.command, &stages.percept));
        if let Some(sentence) = &sentence {
            monitor.speech(&speech(sentence), &mut events);
        }
        monitor.record(0, std::mem::take(&mut events))?;
        progress(&stages, sentence.as_ref());
        if duration.is_none() && end == most && stages.complete() {
            end = most.min(stages.ticks() + AFTER_COMPLETION);
        }
    }
    let elapsed = started.elapsed();
    let summary = monitor.finish(environment::of_machine(), stages.ticks() * PERIOD_NS)?;
    Ok(FinishedRun { summary, ticks: stages.ticks(), elapsed })
}

fn monitor(settings: &RunSettings, stages: &Lockstep) -> Result<Monitor, RunError> {
    let folder = settings.pipeline.parent().unwrap_or(std::path::Path::new("."));
    Ok(Monitor::open(Watched {
        report: settings.report.clone(),
        task: stages.task().clone(),
        intentions: Intentions::from(stages.plan()),
        nodes: Vec::new(),
        limits: Robot::load(&settings.robot)?.limits()[..ARM_JOINTS].to_vec(),
        separation: stages.separation_meter()?,
        fresh: SafetyLimits::load(&settings.safety)?.stale.input_after,
        rules: Rules::load(&folder.join(Rules::FILE))?,
        start_ns: 0,
        started: SystemTime::now(),
    })?)
}

/// The message that the voice's process would publish.
fn speech(sentence: &Sentence) -> Speech {
    let mut speech: Speech = bytemuck::Zeroable::zeroed();
    speech.header = Header { cycle: sentence.cycle, ..Header::default() };
    speech.write(&sentence.text);
    speech
}
