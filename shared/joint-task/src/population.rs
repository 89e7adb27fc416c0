use crate::{Act, ActionType, Agent, Task};
use coact_messages::LayerKind;

/// One population of a layer, or one channel of the percept, and what it stands for in the task.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Population {
    /// What it stands for, in words.
    pub label: String,
    /// Role that rules select by: how an act, chain or action works (see the network file).
    pub role: &'static str,
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
    /// Whether nothing comes before this subgoal in the plan.
    pub first: bool,
}

/// The populations of `layer`, in their order in the field.
pub(crate) fn populations(task: &Task, layer: LayerKind) -> Vec<Population> {
    match layer {
        LayerKind::ActionObservation => acts(task),
        LayerKind::ObjectMemoryRobot => objects(task, Agent::Robot),
        LayerKind::ObjectMemoryPerson => objects(task, Agent::Person),
        LayerKind::SubgoalsAchieved | LayerKind::SubgoalsAvailable => subgoals(task),
        LayerKind::ActionSimulation => chains(task),
        LayerKind::Intention => goals(task),
        LayerKind::ErrorMonitoring => errors(task),
        LayerKind::ActionExecution => actions(task),
    }
}

pub(crate) fn acts(task: &Task) -> Vec<Population> {
    let act = |(index, act): (usize, &Act)| {
        let nothing = Population::default();
        let meaning = match *act {
            Act::Rest => Population { role: "rest", ..nothing },
            Act::Idle => Population { role: "idle", ..nothing },
            Act::Reach => Population { role: "reach", ..nothing },
            Act::Hidden => Population { role: "hidden", ..nothing },
            Act::Gesture(gesture) => Population { role: "gesture", gesture: Some(gesture), ..nothing },
            Act::Word(chain) => Population {
                role: "word",
                kind: Some(task.chains[chain].kind),
                chain: Some(task.chains[chain].name.clone()),
                chain_index: Some(chain),
                ..nothing
            },
            Act::Grasp { grip, kind } => {
                Population { role: "grasp", grip: Some(grip), kind: Some(kind), ..nothing }
            }
        };
        Population { label: task.act_name(index), act: Some(index), ..meaning }
    };
    task.acts.iter().enumerate().map(act).collect()
}

pub(crate) fn objects(task: &Task, workspace: Agent) -> Vec<Population> {
    let object = |(index, kind): (usize, &crate::Kind)| Population {
        label: kind.name.clone(),
        role: "object",
        kind: Some(index),
        workspace: Some(workspace),
        ..Population::default()
    };
    task.kinds.iter().enumerate().map(object).collect()
}

pub(crate) fn subgoals(task: &Task) -> Vec<Population> {
    (0..task.subgoals.len()).map(|index| of_subgoal(task, index)).collect()
}

/// What can be wrong: the goal (its turn has not come, or it is done already), the means (a part is asked for that is at
/// hand), and what the robot itself does (a part is lost).
fn errors(task: &Task) -> Vec<Population> {
    let goals = subgoals(task).into_iter().map(|goal| Population { role: "goal", ..goal });
    let done = subgoals(task).into_iter().map(|goal| Population {
        role: "done",
        label: format!("done: {}", goal.label),
        ..goal
    });
    let of_kind = |role: &'static str, what: &'static str| {
        let error =
            move |part: Population| Population { role, label: format!("{what}: {}", part.label), ..part };
        objects(task, Agent::Person).into_iter().map(error)
    };
    goals.chain(done).chain(of_kind("means", "at hand")).chain(of_kind("loss", "lost")).collect()
}

fn of_subgoal(task: &Task, index: usize) -> Population {
    let subgoal = &task.subgoals[index];
    Population {
        label: subgoal.name.clone(),
        role: "subgoal",
        kind: Some(subgoal.kind),
        subgoal: Some(index),
        side: Some(subgoal.side),
        steadied: subgoal.steadied,
        first: subgoal.after.is_empty(),
        ..Population::default()
    }
}

fn chains(task: &Task) -> Vec<Population> {
    let chain = |(index, chain): (usize, &crate::Chain)| {
        let (role, grip, gesture) = match chain.act {
            Act::Grasp { grip, .. } => ("grip", Some(grip), None),
            Act::Gesture(gesture) => ("gesture", None, Some(gesture)),
            Act::Rest | Act::Idle | Act::Reach | Act::Hidden | Act::Word(_) => ("movement", None, None),
        };
        Population {
            label: format!("{}: {}", chain.name, task.kinds[chain.kind].name),
            role,
            grip,
            gesture,
            kind: Some(chain.kind),
            side: Some(chain.side),
            workspace: Some(chain.from),
            chain: Some(chain.name.clone()),
            chain_index: Some(index),
            answer: chain.answer.clone(),
            ..Population::default()
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
    let action = |action: &crate::Action| {
        let subgoal = action.subgoal.map(|index| of_subgoal(task, index)).unwrap_or_default();
        Population {
            label: action.name.clone(),
            role: type_name(action.action_type),
            kind: action.kind,
            rule: Some(action.rule.clone()),
            ..subgoal
        }
    };
    task.actions.iter().map(action).collect()
}

fn type_name(action_type: ActionType) -> &'static str {
    match action_type {
        ActionType::Insert => "insert",
        ActionType::Request => "request",
        ActionType::Receive => "receive",
        ActionType::Give => "give",
        ActionType::Steady => "steady",
        ActionType::Point => "point",
        ActionType::Speak => "speak",
        ActionType::Report => "report",
    }
}
