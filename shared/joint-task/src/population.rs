use crate::{Act, Action, Agent, Chain, Choice, Kind, Role, Task};
use coact_messages::LayerKind;

/// One population of a layer, or one channel of the percept, and what it stands for in the task.
#[derive(Debug, Clone, PartialEq)]
pub struct Population {
    /// What it stands for, in words.
    pub label: String,
    /// What rules select by.
    pub role: Role,
    /// Index of the observable act.
    pub act: Option<usize>,
    /// Index of the kind of part.
    pub kind: Option<usize>,
    /// Index of the grip.
    pub grip: Option<usize>,
    /// Index of the gesture.
    pub gesture: Option<usize>,
    /// Index of the subgoal.
    pub subgoal: Option<usize>,
    /// Index of the choice.
    pub choice: Option<usize>,
    /// Whose subgoal.
    pub side: Option<Agent>,
    /// In whose workspace the part is.
    pub workspace: Option<Agent>,
    /// Name of the chain's rule.
    pub chain: Option<String>,
    /// Index of the chain, where the population stands for one.
    pub chain_index: Option<usize>,
    /// Name of the action that answers the chain.
    pub answer: Option<String>,
    /// Name of the action's rule.
    pub rule: Option<String>,
    /// Whether the other one steadies the base for this subgoal.
    pub steadied: bool,
}

impl Population {
    /// A population that stands for nothing of the task's lists.
    pub(crate) fn new(role: Role, label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            role,
            act: None,
            kind: None,
            grip: None,
            gesture: None,
            subgoal: None,
            choice: None,
            side: None,
            workspace: None,
            chain: None,
            chain_index: None,
            answer: None,
            rule: None,
            steadied: false,
        }
    }
}

/// The populations of `layer`, in their order in the field.
pub(crate) fn populations(task: &Task, layer: LayerKind) -> Vec<Population> {
    match layer {
        LayerKind::ActionObservation => acts(task),
        LayerKind::ObjectMemoryRobot => objects(task, Agent::Robot),
        LayerKind::ObjectMemoryPerson => objects(task, Agent::Person),
        LayerKind::SubgoalsAchieved => subgoals(task).into_iter().chain(choices(task)).collect(),
        LayerKind::SubgoalsAvailable => subgoals(task),
        LayerKind::ActionSimulation => chains(task),
        LayerKind::Intention => goals(task),
        LayerKind::ErrorMonitoring => errors(task),
        LayerKind::ActionExecution => actions(task),
    }
}

pub(crate) fn acts(task: &Task) -> Vec<Population> {
    let act = |(index, act): (usize, &Act)| {
        let of = |role| Population { act: Some(index), ..Population::new(role, task.act_name(index)) };
        match *act {
            Act::Rest => of(Role::Rest),
            Act::Idle => of(Role::Idle),
            Act::Reach => of(Role::Reach),
            Act::Hidden => of(Role::Hidden),
            Act::Gesture(gesture) => Population { gesture: Some(gesture), ..of(Role::Gesture) },
            Act::Word(chain) => of_chain(of(Role::Word), task, chain),
            Act::Point(chain) => of_chain(of(Role::Point), task, chain),
            Act::Grasp { grip, kind } => Population { grip: Some(grip), kind: Some(kind), ..of(Role::Grasp) },
        }
    };
    task.acts.iter().enumerate().map(act).collect()
}

/// An act that names a chain.
fn of_chain(act: Population, task: &Task, chain: usize) -> Population {
    let Chain { kind, ref name, .. } = task.chains[chain];
    Population { kind: Some(kind), chain: Some(name.clone()), chain_index: Some(chain), ..act }
}

pub(crate) fn objects(task: &Task, workspace: Agent) -> Vec<Population> {
    let object = |(index, kind): (usize, &Kind)| Population {
        kind: Some(index),
        workspace: Some(workspace),
        ..Population::new(Role::Object, &kind.name)
    };
    task.kinds.iter().enumerate().map(object).collect()
}

pub(crate) fn subgoals(task: &Task) -> Vec<Population> {
    (0..task.subgoals.len()).map(|index| of_subgoal(task, index)).collect()
}

fn choices(task: &Task) -> impl Iterator<Item = Population> {
    let choice = |(index, choice): (usize, &Choice)| Population {
        choice: Some(index),
        ..Population::new(Role::Choice, &choice.name)
    };
    task.choices.iter().enumerate().map(choice)
}

/// What can be wrong: the goal (its turn has not come, or it is done already), the means (a part is asked for that is at
/// hand), and what the robot itself does (a part is lost).
fn errors(task: &Task) -> Vec<Population> {
    let goals = subgoals(task).into_iter().map(|goal| Population { role: Role::Goal, ..goal });
    let done = subgoals(task).into_iter().map(|goal| Population {
        role: Role::Done,
        label: format!("done: {}", goal.label),
        ..goal
    });
    let of_kind = |role: Role, what: &'static str| {
        let error =
            move |part: Population| Population { role, label: format!("{what}: {}", part.label), ..part };
        objects(task, Agent::Person).into_iter().map(error)
    };
    goals.chain(done).chain(of_kind(Role::Means, "at hand")).chain(of_kind(Role::Loss, "lost")).collect()
}

fn of_subgoal(task: &Task, index: usize) -> Population {
    let subgoal = &task.subgoals[index];
    Population {
        kind: Some(subgoal.kind),
        subgoal: Some(index),
        side: Some(subgoal.side),
        steadied: subgoal.steadied,
        ..Population::new(Role::Subgoal, &subgoal.name)
    }
}

fn chains(task: &Task) -> Vec<Population> {
    let chain = |(index, chain): (usize, &Chain)| {
        let (role, grip, gesture) = match chain.act {
            Act::Grasp { grip, .. } => (Role::Grip, Some(grip), None),
            Act::Gesture(gesture) => (Role::Gesture, None, Some(gesture)),
            Act::Rest | Act::Idle | Act::Reach | Act::Hidden | Act::Word(_) | Act::Point(_) => {
                (Role::Movement, None, None)
            }
        };
        Population {
            grip,
            gesture,
            kind: Some(chain.kind),
            side: Some(chain.side),
            workspace: Some(chain.from),
            chain: Some(chain.name.clone()),
            chain_index: Some(index),
            answer: chain.answer.clone(),
            ..Population::new(role, format!("{}: {}", chain.name, task.kinds[chain.kind].name))
        }
    };
    task.chains.iter().enumerate().map(chain).collect()
}

/// One goal for each chain and each subgoal that it can serve: those of its side, or, where its kind of part is
/// needed on the other side only, those (the person may be about to do the wrong thing).
fn goals(task: &Task) -> Vec<Population> {
    let mut goals = Vec::new();
    for chain in chains(task) {
        let of_kind = |&index: &usize| Some(task.subgoals[index].kind) == chain.kind;
        let of_side = |&index: &usize| Some(task.subgoals[index].side) == chain.side;
        let all: Vec<usize> = (0..task.subgoals.len()).filter(of_kind).collect();
        let own: Vec<usize> = all.iter().copied().filter(of_side).collect();
        for subgoal in if own.is_empty() { all } else { own } {
            let target = of_subgoal(task, subgoal);
            goals.push(Population {
                label: format!("{}: {}", chain.chain.as_deref().unwrap_or_default(), target.label),
                role: chain.role,
                side: chain.side,
                chain: chain.chain.clone(),
                chain_index: chain.chain_index,
                answer: chain.answer.clone(),
                ..target
            });
        }
    }
    goals
}

fn actions(task: &Task) -> Vec<Population> {
    let action = |action: &Action| {
        let role = Role::from(action.action_type);
        let served = action.subgoal.map(|index| of_subgoal(task, index));
        Population {
            label: action.name.clone(),
            role,
            kind: action.kind,
            rule: Some(action.rule.clone()),
            ..served.unwrap_or_else(|| Population::new(role, ""))
        }
    };
    task.actions.iter().map(action).collect()
}
