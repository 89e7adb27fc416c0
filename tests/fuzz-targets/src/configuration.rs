//! Files of `rt-config` but the robot's, and those that people write beside them.

use crate::scratch::Scratch;
use crate::seeds::checkout;
use coact_console::ConsoleSettings;
use coact_fields::Network;
use coact_joint_task::{NetworkPlan, Task, check};
use coact_learning::{Demonstration, SerialOrder, TaskText};
use coact_messages::FieldFrame;
use coact_monitor::Rules;
use coact_perception::{Perception, PreshapeModel};
use coact_pipeline::Pipeline;
use coact_recorder::RecorderSettings;
use coact_safety::SafetyLimits;
use coact_world::Scenario;
use std::path::Path;
use std::sync::LazyLock;

static TASK: LazyLock<Task> = LazyLock::new(|| Task::load(&shipped("tasks/toy-vehicle.toml")).unwrap());

pub(crate) fn shipped(name: &str) -> std::path::PathBuf {
    checkout().join("rt-config").join(name)
}

/// The task that all other files belong to.
pub(crate) fn task() -> &'static Task {
    &TASK
}

/// Whether something was read; why not is put into words, as for the user.
pub(crate) fn taken<T, E: std::fmt::Display>(read: Result<T, E>) -> Option<T> {
    read.map_err(|why| why.to_string()).ok()
}

pub(crate) fn process_table(bytes: &[u8]) -> bool {
    Scratch::with("pipeline.toml", bytes, |path| taken(Pipeline::load(path)).is_some())
}

pub(crate) fn recorder_settings(bytes: &[u8]) -> bool {
    Scratch::with("recorder.toml", bytes, |path| taken(RecorderSettings::load(path)).is_some())
}

pub(crate) fn console_settings(bytes: &[u8]) -> bool {
    Scratch::with("console.toml", bytes, |path| taken(ConsoleSettings::load(path)).is_some())
}

pub(crate) fn safety_limits(bytes: &[u8]) -> bool {
    Scratch::with("safety.toml", bytes, |path| taken(SafetyLimits::load(path)).is_some())
}

pub(crate) fn verdict_rules(bytes: &[u8]) -> bool {
    Scratch::with("verdict.toml", bytes, |path| taken(Rules::load(path)).is_some())
}

pub(crate) fn network_file(bytes: &[u8]) -> bool {
    Scratch::with("joint-action.toml", bytes, |path| {
        taken(NetworkPlan::of_task(task().clone(), path)).is_some_and(|(task, plan)| steps(&task, plan))
    })
}

pub(crate) fn task_file(bytes: &[u8]) -> bool {
    beside_the_network();
    Scratch::with("tasks/task.toml", bytes, |path| {
        let Some((task, plan)) = taken(NetworkPlan::load(path)) else { return false };
        check(path).unwrap();
        let order: Vec<Vec<usize>> = task.subgoals.iter().map(|subgoal| subgoal.after.clone()).collect();
        let mut text = TaskText::read(path).unwrap();
        text.set_plan(&order);
        let copy = path.with_file_name("copy.toml");
        text.write(&copy).unwrap();
        assert_eq!(Task::load(&copy).unwrap().subgoals, task.subgoals, "what is written is what was read");
        steps(&task, plan)
    })
}

pub(crate) fn learned_mapping(bytes: &[u8]) -> bool {
    beside_the_network();
    let task = std::fs::read_to_string(shipped("tasks/toy-vehicle.toml")).unwrap();
    let task = task.replacen("network = ", "learned = \"learned.toml\"\nnetwork = ", 1);
    Scratch::file("tasks/taught.toml", task.as_bytes());
    Scratch::with("tasks/learned.toml", bytes, |path| {
        let loaded = NetworkPlan::load(&path.with_file_name("taught.toml"));
        taken(loaded).is_some_and(|(task, plan)| steps(&task, plan))
    })
}

/// Puts the network file where the shipped tasks look for it.
fn beside_the_network() {
    if !Scratch::folder().join("joint-action.toml").exists() {
        Scratch::file("joint-action.toml", &std::fs::read(shipped("joint-action.toml")).unwrap());
    }
}

/// Whether a network can be made of the plan; it then takes a step from rest.
fn steps(task: &Task, plan: NetworkPlan) -> bool {
    let Some(mut network) = taken(Network::new(plan, task.fingerprint, 1)) else { return false };
    let mut rest: Box<FieldFrame> = bytemuck::zeroed_box();
    let mut next = rest.clone();
    network.rest(&mut rest);
    network.step(1, None, &rest, &mut next);
    true
}

pub(crate) fn scenario(bytes: &[u8]) -> bool {
    Scratch::with("scenario.toml", bytes, |path| taken(Scenario::load(path, task())).is_some())
}

pub(crate) fn preshape_model(bytes: &[u8]) -> bool {
    Scratch::with("preshape.toml", bytes, |path| {
        taken(PreshapeModel::load(path)).is_some_and(|model| taken(Perception::new(task(), &model)).is_some())
    })
}

pub(crate) fn demonstration(bytes: &[u8]) -> bool {
    Scratch::with("demonstration.toml", bytes, learned)
}

pub(crate) fn demonstration_table(bytes: &[u8]) -> bool {
    Scratch::with("demonstration.csv", bytes, learned)
}

/// Whether it is a demonstration; what can be learned of it, is.
pub(crate) fn learned(path: &Path) -> bool {
    static PLAN: LazyLock<NetworkPlan> =
        LazyLock::new(|| NetworkPlan::load(&shipped("tasks/toy-vehicle.toml")).unwrap().1);
    let names: Vec<_> = task().subgoals.iter().map(|subgoal| subgoal.name.clone()).collect();
    let Some(read) = taken(Demonstration::read(path, &names)) else { return false };
    // Learning takes a second for each second that was demonstrated: that is no fault of a reader.
    let length = |demonstration: &Demonstration| demonstration.steps.last().map_or(0, |step| step.at_ms);
    if let Some(brief) = read.iter().find(|read| length(read) < 100) {
        let mut learner = SerialOrder::new(&PLAN).unwrap();
        learner.watch(brief);
        learner.order();
    }
    true
}
