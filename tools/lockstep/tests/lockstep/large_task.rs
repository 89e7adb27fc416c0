//! A task of 50 subgoals and 30 parts fits into the messages, and its network decides.
#![allow(clippy::unwrap_used, clippy::expect_used)]

use crate::generated;
use coact_fields::Network;
use coact_joint_task::{Agent, NetworkPlan};
use coact_messages::{FieldFrame, LayerKind, MAX_POPULATIONS, Percept};

#[test]
fn network_of_fifty_subgoals_and_thirty_parts_decides() {
    let folder = tempfile::tempdir().unwrap();
    let path = generated::write(folder.path(), 50, 30);
    let (task, plan) = NetworkPlan::load(&path).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((task.subgoals.len(), task.parts.len()), (50, 30));
    assert!(plan.populations.len() <= MAX_POPULATIONS);
    let available = plan.layer(LayerKind::SubgoalsAvailable).populations.clone();
    let mut percept: Box<Percept> = bytemuck::zeroed_box();
    for part in &task.parts {
        percept.workspace[part.workspace.index()].seen[part.kind] = 1.0;
    }
    percept.open[..50].fill(1.0);
    let mut network = Network::new(plan, task.fingerprint, 1).unwrap();
    let (mut now, mut next): (Box<FieldFrame>, Box<FieldFrame>) =
        (bytemuck::zeroed_box(), bytemuck::zeroed_box());
    network.rest(&mut now);
    for tick in 0..500 {
        percept.header.cycle = tick;
        network.step(tick, Some(&percept), &now, &mut next);
        std::mem::swap(&mut now, &mut next);
    }
    let open: Vec<usize> = (0..50).filter(|goal| now.signal[available.start + goal] > 0.5).collect();
    assert_eq!(open, [0, 1], "the first of each side");
    let action = &task.actions[now.decision.action as usize];
    assert_eq!(action.subgoal, Some(1), "the robot begins with its own part: {}", action.name);
    assert_eq!(task.subgoals[1].side, Agent::Robot);
}
