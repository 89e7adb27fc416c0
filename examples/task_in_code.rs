//! A task made in code, and its network stepped until it decides: the person reaches for a block, and the hand's shape
//! tells more and more that it will be handed over. The network decides to receive it while the hand still moves.
//!
//! `cargo run -p coact-examples --example task_in_code`

use coact_fields::Network;
use coact_joint_task::{
    Act, Action, ActionType, Agent, Chain, Fit, Kind, NetworkPlan, Part, PersonGrip, Scene, Shape, Subgoal,
    Task,
};
use coact_messages::{FieldFrame, NONE, PERSON, Percept, ROBOT};
use std::path::Path;

/// Grips of the person, by their index: from above to insert, from the side to hand over.
const TOP: usize = 0;
const SIDE: usize = 1;

fn main() -> anyhow::Result<()> {
    // The rules that make populations and synapses are the same for every task.
    let rules = Path::new(env!("CARGO_MANIFEST_DIR")).join("../rt-config/joint-action.toml");
    let (task, plan) = NetworkPlan::of_task(task(), &rules)?;
    println!("{} populations, {} synapses", plan.populations.len(), plan.synapses.len());
    let mut network = Network::new(plan, task.fingerprint, 1)?;

    let (mut now, mut next): (Box<FieldFrame>, Box<FieldFrame>) =
        (bytemuck::zeroed_box(), bytemuck::zeroed_box());
    network.rest(&mut now);
    let mut percept: Box<Percept> = bytemuck::zeroed_box();
    percept.workspace[PERSON].seen[0] = 1.0; // the block lies before the person ...
    percept.workspace[ROBOT].gone[0] = 1.0; // ... and none before the robot
    percept.open[..task.subgoals.len()].fill(1.0);
    let act = |wanted: Act| task.acts.iter().position(|act| *act == wanted).unwrap_or(0);

    for tick in 0..2000 {
        // The person rests for 0.5 s, then reaches for 0.8 s; evidence for the grip grows with the hand's way.
        let way = (tick as f64 - 500.0) / 800.0;
        percept.header.cycle = tick;
        percept.act[act(Act::Rest)] = f64::from(way < 0.0);
        percept.act[act(Act::Reach)] = f64::from(way >= 0.0);
        percept.act[act(Act::Grasp { grip: SIDE, kind: 0 })] = way.clamp(0.0, 1.0);
        network.step(tick, Some(&percept), &now, &mut next);
        std::mem::swap(&mut now, &mut next);
        if now.decision.action != NONE {
            let decided = &task.actions[now.decision.action as usize].name;
            println!("{tick} ms, {:.0} % of the reach: decides: {decided}", 100.0 * way);
            return Ok(());
        }
    }
    anyhow::bail!("no decision in 2 s")
}

fn task() -> Task {
    let chain = |name: &str, grip, side, answer: &str| Chain {
        name: name.into(),
        act: Act::Grasp { grip, kind: 0 },
        kind: 0,
        from: Agent::Person,
        side,
        answer: Some(answer.into()), // the robot's action that complements it
        pointing: false,
        says: Vec::new(),
    };
    let subgoal = |name: &str, side, x, steadied| Subgoal {
        name: name.into(),
        kind: 0,
        side,
        socket: [x, 0.3, 0.89],
        axis: [0.0, 0.0, 1.0],
        steadied,
        after: Vec::new(),         // subgoals that must be achieved before
        after_choices: Vec::new(), // choices that must be made before
    };
    let action = |rule: &str, action_type, subgoal| Action {
        name: format!("{rule} the block"),
        rule: rule.into(),
        action_type,
        kind: Some(0),
        subgoal: Some(subgoal),
    };
    let grip = |name: &str, pitch: f64| PersonGrip { name: name.into(), pitch: pitch.to_radians() };
    let shape = Shape::Cylinder { radius: 0.03, height: 0.04 };
    Task {
        name: "one block".into(),
        kinds: vec![Kind { name: "block".into(), width: 0.06, shape, mass: 0.1 }],
        parts: vec![Part { kind: 0, workspace: Agent::Person, at: [-0.96, 0.06] }],
        subgoals: vec![
            subgoal("block on the person's side", Agent::Person, -0.69, true),
            subgoal("block on the robot's side", Agent::Robot, -0.55, false),
        ],
        choices: Vec::new(),
        grips: vec![grip("top", -75.0), grip("side", -10.0)],
        gestures: Vec::new(),
        acts: vec![
            Act::Rest,
            Act::Idle,
            Act::Reach,
            Act::Hidden,
            Act::Grasp { grip: TOP, kind: 0 },
            Act::Grasp { grip: SIDE, kind: 0 },
        ],
        chains: vec![
            chain("insert", TOP, Agent::Person, "steady"),
            chain("hand over", SIDE, Agent::Robot, "receive"),
        ],
        actions: vec![action("steady", ActionType::Steady, 0), action("receive", ActionType::Receive, 1)],
        scene: scene(),
        fingerprint: 1, // differs from that of any other task of the program
    }
}

/// The table between the two; the network knows nothing of it, a world and an arm would.
fn scene() -> Scene {
    Scene {
        table_height: 0.80,
        table_centre: [-0.74, 0.30],
        table_size: [1.04, 1.20],
        platform: [-0.62, 0.30, 0.86],
        platform_radius: 0.12,
        platform_height: 0.03,
        steady: vec![[-0.62, 0.41, 0.90]],
        handover: [-0.60, 0.15, 1.00],
        person_rest: [-1.22, 0.20, 0.83],
        person_shoulder: [-1.28, 0.12, 1.18],
        workspace: [[[-0.58, 0.44], [-0.26, 0.78]], [[-1.17, 0.00], [-0.92, 0.60]]],
        fit: Fit { position: 0.008, angle: 8.0_f64.to_radians() },
    }
}
