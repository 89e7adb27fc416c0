use crate::Encounter;
use crate::parallel::in_parallel;
use coact_joint_task::{ActionType, Task};
use coact_lockstep::{Lockstep, LockstepError};
use coact_messages::{ARM_JOINTS, JOINTS};
use coact_period::{PERIOD_S, cycles};
use coact_pipeline::RunSettings;
use coact_recordings::{ArmRecording, ArmSide};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Encounters of the working robot with recorded people.
#[derive(Debug, Clone)]
pub struct Encounters<'a> {
    /// Task, robot, world; the seed is that of the first encounter, the next ones follow. The partner is left out.
    pub settings: &'a RunSettings,
    /// Arms that were recorded, each with its file; taken in turn.
    pub arms: &'a [(PathBuf, ArmSide)],
    /// How many encounters.
    pub count: u64,
    /// How many at the same time.
    pub threads: usize,
}

/// How long the robot is about one thing before it is to do another one, ticks. Chosen by hand: a movement takes one to two
/// seconds, so that it moves most of the time, and now and then turns round on its way.
const WORKS: Range<u64> = cycles(Duration::from_millis(1500))..cycles(Duration::from_millis(3500));
/// Joint speed from which the robot moves, rad/s: the hand then moves by 1 cm/s at most.
const MOVES: f64 = 0.01;

/// Runs all encounters in parallel and returns them in the order of their seeds; `done` is called after each.
///
/// # Errors
/// A file or setting that a stage refuses.
pub fn encounter(encounters: &Encounters, done: impl Fn() + Sync) -> Result<Vec<Encounter>, LockstepError> {
    in_parallel(encounters.count, encounters.threads, |index| {
        let (file, side) = &encounters.arms[index as usize % encounters.arms.len()];
        let seed = encounters.settings.seed.wrapping_add(index);
        let encounter = meet(encounters.settings, file, *side, seed)?;
        done();
        Ok(encounter)
    })
}

/// One encounter, for as long as the arm was recorded.
fn meet(settings: &RunSettings, file: &Path, side: ArmSide, seed: u64) -> Result<Encounter, LockstepError> {
    let partner = format!("{}-arm:{}", side.name(), file.display());
    let mut stages = Lockstep::new(&RunSettings { seed, partner, ..settings.clone() })?;
    let duration = ArmRecording::read(file, side).map_err(coact_person::PersonError::from);
    let duration = duration.map_err(coact_world::WorldError::from)?.duration;
    let mut meter = stages.separation_meter()?;
    let mut work = Work::of(stages.task(), seed);
    let (mut moved_ms, mut handover_ms, mut before) = (0, 0, None);
    while (stages.ticks() as f64) * PERIOD_S < duration {
        stages.decide(work.at(stages.ticks()));
        stages.step();
        meter.tick(&stages.truth, &stages.command);
        let joints = stages.truth.joints;
        moved_ms += u64::from(before.is_some_and(|before| moves(&before, &joints)));
        handover_ms += u64::from(stages.command.handover != 0);
        before = Some(joints);
    }
    let separation = meter.report().clone();
    Ok(Encounter { recording: name(file), arm: side.name(), seed, moved_ms, handover_ms, separation })
}

fn moves(before: &[f64; JOINTS], now: &[f64; JOINTS]) -> bool {
    before.iter().zip(now).take(ARM_JOINTS).any(|(before, now)| (now - before).abs() > MOVES * PERIOD_S)
}

/// A recording's folder and file, without the path to them.
fn name(file: &Path) -> String {
    let last = file.components().rev().take(2).collect::<Vec<_>>();
    last.into_iter().rev().collect::<PathBuf>().display().to_string()
}

/// What the robot is to do, in the place of decisions: one thing after the other for which it needs nobody, so that it moves
/// from part to part whatever the recorded person does. No handover is among it.
struct Work {
    actions: Vec<u32>,
    rng: Pcg32,
    present: Option<u32>,
    until: u64,
}

impl Work {
    fn of(task: &Task, seed: u64) -> Self {
        let alone = |action_type| {
            matches!(
                action_type,
                ActionType::Insert | ActionType::Steady | ActionType::Point | ActionType::Request
            )
        };
        let actions = task.actions.iter().zip(0..).filter(|(action, _)| alone(action.action_type));
        let actions = actions.map(|(_, index)| index).collect();
        Self { actions, rng: Pcg32::seed_from_u64(seed), present: None, until: 0 }
    }

    /// The action to be carried out at `tick`; none: the arm parks.
    fn at(&mut self, tick: u64) -> Option<u32> {
        if tick >= self.until {
            let others = self.actions.iter().copied().map(Some).chain([None]);
            let others: Vec<_> = others.filter(|action| *action != self.present).collect();
            let choice = self.rng.random_range(0..others.len().max(1));
            self.present = others.get(choice).copied().flatten();
            self.until = tick + self.rng.random_range(WORKS);
        }
        self.present
    }
}
