use crate::population::{Population, acts, objects, subgoals};
use crate::{Act, Agent, Channel, ChannelPlan, Role, Task};
use std::ops::Range;

/// All channels of the percept, and their names in the network file with their places behind `first`.
pub(crate) fn channels(task: &Task, first: usize) -> (Vec<ChannelPlan>, Vec<(String, Range<usize>)>) {
    let mut channels = Vec::new();
    let mut names = Vec::new();
    let mut add = |name: &str, meanings: Vec<Population>, channel: &dyn Fn(usize) -> Channel| {
        let start = first + channels.len();
        let plan = |(index, meaning): (usize, Population)| ChannelPlan {
            channel: channel(index),
            meaning: Population { label: format!("{name}: {}", meaning.label), ..meaning },
        };
        channels.extend(meanings.into_iter().enumerate().map(plan));
        names.push((name.to_string(), start..first + channels.len()));
    };
    add("always", vec![Population::new(Role::Always, "")], &|_| Channel::Always);
    add("acts", acts(task), &|act| of_act(task, act));
    let (meanings, channel): (Vec<_>, Vec<_>) = destinations(task).into_iter().unzip();
    add("destinations", meanings, &|index| channel[index]);
    add("bound for", objects(task, Agent::Person), &Channel::BoundFor);
    for (agent, name) in [(Agent::Robot, "robot"), (Agent::Person, "person")] {
        let workspace = agent.index();
        add(&format!("seen {name}"), objects(task, agent), &|kind| Channel::Seen { workspace, kind });
        add(&format!("gone {name}"), objects(task, agent), &|kind| Channel::Gone { workspace, kind });
    }
    add("achieved", subgoals(task), &Channel::Achieved);
    add("open", subgoals(task), &Channel::Open);
    add("robot holds", objects(task, Agent::Robot), &Channel::RobotHolds);
    add("person holds", objects(task, Agent::Person), &Channel::PersonHolds);
    add("lost", objects(task, Agent::Robot), &Channel::Lost);
    (channels, names)
}

/// What is seen of an act; of a grasp, that the hand holds such a part, as far as the grip field's peak stands at that grip.
fn of_act(task: &Task, act: usize) -> Channel {
    match task.acts[act] {
        Act::Grasp { grip, kind } => Channel::Hold { act, grip, kind },
        _ => Channel::Act(act),
    }
}

/// Of each grasp, the destination field's peaks at parts of its kind, as far as the grip field's stands at its grip.
fn destinations(task: &Task) -> Vec<(Population, Channel)> {
    let of_grasp = |(meaning, act): (Population, &Act)| match *act {
        Act::Grasp { grip, kind } => Some((meaning, Channel::Destination { grip, kind })),
        _ => None,
    };
    acts(task).into_iter().zip(&task.acts).filter_map(of_grasp).collect()
}
