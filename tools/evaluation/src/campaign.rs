use crate::parallel::in_parallel;
use crate::trial_recorder::{Ending, TrialRecorder};
use crate::{NetworkVariant, RecordedPerson, Trial};
use coact_control::PlannerDelay;
use coact_lockstep::{Lockstep, LockstepError};
use coact_period::cycles;
use coact_pipeline::{Layout, RunSettings};
use std::path::PathBuf;
use std::time::Duration;

/// An assembly without a new subgoal for so long is given up, ticks: about as long as the toy vehicle takes as a whole.
const STALLED: u64 = cycles(Duration::from_secs(60));

/// Many trials: in each, one person builds one assembly with the robot, or several.
#[derive(Debug, Clone)]
pub struct Campaign<'a> {
    /// Task, robot, model, partner; the seed is that of the first trial, the next ones follow. A random layout is drawn anew for
    /// each. All of a trial follows from its seed, so that any of them can be looked at alone.
    pub settings: &'a RunSettings,
    /// Tasks that the seeds take in turn; without any it is that of the settings.
    pub tasks: &'a [PathBuf],
    /// Who moves the partner's hand: all with each of the tasks, in turn with the seeds; without any it is as the settings say.
    pub people: &'a [RecordedPerson],
    /// The robot's network.
    pub network: &'a NetworkVariant,
    /// Whether the robot's guard holds it back.
    pub guarded: bool,
    /// How long its planner's answers are held back.
    pub planner_delay: PlannerDelay,
    /// How many.
    pub trials: u64,
    /// How many assemblies one person builds in each, one after another: the robot gets to know the person in them.
    pub assemblies: u64,
    /// How many at the same time.
    pub threads: usize,
}

/// Runs all trials in parallel and returns them in the order of their seeds; `done` is called after each.
///
/// # Errors
/// A file or setting that a stage refuses.
pub fn run(campaign: &Campaign, done: impl Fn() + Sync) -> Result<Vec<Trial>, LockstepError> {
    in_parallel(campaign.trials, campaign.threads, |index| {
        let trial = assemble(campaign, index)?;
        done();
        Ok(trial)
    })
}

/// One trial, until its assemblies are complete, nothing is achieved for a minute, or each of their subgoals could have been
/// achieved in that time.
fn assemble(campaign: &Campaign, index: u64) -> Result<Trial, LockstepError> {
    let settings = settings(campaign, index);
    let mut stages = Lockstep::with_plan(&settings, |plan| campaign.network.apply(plan))?;
    if !campaign.guarded {
        stages.leave_unguarded();
    }
    if campaign.network.myopic {
        stages.prepare_nothing();
    }
    stages.hold_plans_back(campaign.planner_delay);
    let (task, plan) = (stages.task().clone(), stages.plan().clone());
    let mut recorder = TrialRecorder::new(&task, &plan, stages.separation_meter()?, settings.seed);
    let longest = STALLED * task.subgoals.len() as u64 * campaign.assemblies;
    let (mut achieved, mut advanced) = (0, 0);
    while stages.ticks() < longest && stages.ticks() < advanced + STALLED {
        stages.step();
        recorder.tick(&stages);
        if stages.truth.achieved != achieved {
            (achieved, advanced) = (stages.truth.achieved, stages.ticks());
        }
        if stages.completed() == campaign.assemblies {
            return Ok(recorder.finish(&stages, Ending::Completed));
        }
    }
    let stalled = stages.ticks() < longest;
    Ok(recorder.finish(&stages, if stalled { Ending::Stalled } else { Ending::TooLong }))
}

/// Those of the trial with this number, from 0.
fn settings(campaign: &Campaign, index: u64) -> RunSettings {
    let Campaign { settings, tasks, people, .. } = *campaign;
    let seed = settings.seed.wrapping_add(index);
    let layout = match settings.layout {
        Layout::Task => Layout::Task,
        Layout::Random(_) => Layout::Random(seed),
    };
    let turns = tasks.len().max(1) as u64;
    let task = tasks.get((seed % turns) as usize).unwrap_or(&settings.task).clone();
    let own = RunSettings { task, seed, layout, ..settings.clone() };
    let person = people.get((seed / turns % people.len().max(1) as u64) as usize).cloned();
    match person {
        Some(RecordedPerson { movement, model }) => RunSettings { movement, model, ..own },
        None => own,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use coact_pipeline::Movement;

    #[test]
    fn assemblies_take_tasks_in_turn_each_with_a_seed_and_a_layout_of_its_own() {
        let own =
            RunSettings { seed: 7, layout: Layout::Random(0), ..RunSettings::shipped("rt-config".as_ref()) };
        let network = NetworkVariant::default();
        let tasks = ["a.toml", "b.toml"].map(PathBuf::from);
        let campaign = Campaign {
            settings: &own,
            tasks: &tasks,
            people: &[],
            network: &network,
            guarded: true,
            planner_delay: PlannerDelay::None,
            trials: 3,
            assemblies: 1,
            threads: 1,
        };
        let taken = [0, 1, 2].map(|index| settings(&campaign, index));
        assert_eq!(
            taken.each_ref().map(|settings| settings.task.clone()),
            ["b.toml", "a.toml", "b.toml"].map(PathBuf::from)
        );
        assert_eq!(taken.each_ref().map(|settings| settings.seed), [7, 8, 9]);
        assert_eq!(taken.each_ref().map(|settings| settings.layout), [7, 8, 9].map(Layout::Random));
        let alone = RunSettings { seed: 8, ..own.clone() };
        assert_eq!(settings(&Campaign { settings: &alone, ..campaign }, 0), taken[1]);
        let without = Campaign { tasks: &[], ..campaign };
        assert_eq!(settings(&without, 1).task, own.task);
    }

    #[test]
    fn each_person_moves_the_hand_in_each_task_read_by_who_does_not_know_them() {
        let own = RunSettings { seed: 8, ..RunSettings::shipped("rt-config".as_ref()) };
        let people = [1, 2].map(|participant| RecordedPerson {
            movement: Movement::Recorded { folder: "reaches".into(), participant },
            model: format!("without-{participant}.toml").into(),
        });
        let tasks = ["a.toml", "b.toml"].map(PathBuf::from);
        let network = NetworkVariant::default();
        let campaign = Campaign {
            settings: &own,
            tasks: &tasks,
            people: &people,
            network: &network,
            guarded: true,
            planner_delay: PlannerDelay::None,
            trials: 5,
            assemblies: 1,
            threads: 1,
        };
        let taken = |index| {
            let RunSettings { task, movement, model, .. } = settings(&campaign, index);
            (task, RecordedPerson { movement, model })
        };
        let [one, other] = people.clone();
        let expected = [(0, &one), (1, &one), (0, &other), (1, &other), (0, &one)];
        assert_eq!(
            [0, 1, 2, 3, 4].map(taken),
            expected.map(|(task, person)| (tasks[task].clone(), person.clone()))
        );
        assert_eq!(settings(&Campaign { people: &[], ..campaign }, 3).movement, Movement::MinimumJerk);
    }
}
