//! A small task of its own, and hand-made messages for it.

pub mod schema;

use coact_joint_task::{
    Act, Action, ActionType, Agent, Chain, Kind, Part, PersonGrip, Scene, Shape, Subgoal, Task,
};
use coact_messages::{ARM_JOINTS, FieldFrame, LayerKind, NONE, PartnerPhase, Pulse, SensorSample, Truth};
use coact_monitor::Intentions;
use coact_period::PERIOD_NS;
use coact_robot::JointLimits;

/// Chains, subgoals and actions of [`task`].
pub const MOUNT: u32 = 0;
pub const PASS: u32 = 1;
pub const LID: u32 = 0;
pub const HINGE: u32 = 1;
pub const STEADY_LID: usize = 0;
pub const RECEIVE_HINGE: usize = 1;
pub const REQUEST: usize = 2;
pub const OBJECT_TO_HINGE: usize = 3;
pub const GIVE_HINGE: usize = 4;
/// The goal of mounting the lid, in the intention layer.
pub const MOUNTING_LID: usize = 1;

fn subgoal(name: &str, steadied: bool, after: Vec<usize>) -> Subgoal {
    let (name, axis, side) = (name.into(), [0.0, 0.0, 1.0], Agent::Person);
    Subgoal { name, kind: 0, side, socket: [0.0; 3], axis, steadied, after, after_choices: Vec::new() }
}

fn chain(name: &str, answer: &str) -> Chain {
    let act = Act::Grasp { grip: 0, kind: 0 };
    let (from, side) = (Agent::Person, Agent::Person);
    let (name, answer) = (name.into(), Some(answer.into()));
    Chain { name, act, kind: 0, from, side, answer, pointing: false, says: Vec::new() }
}

fn action(rule: &str, action_type: ActionType, subgoal: usize, name: &str) -> Action {
    let name = format!("{rule}: {name}");
    Action { name, rule: rule.into(), action_type, kind: Some(0), subgoal: Some(subgoal) }
}

/// A box with a lid (that must be steadied) and a hinge (that must not).
pub fn task() -> Task {
    Task {
        name: "box".into(),
        kinds: vec![Kind {
            name: "plate".into(),
            width: 0.05,
            shape: Shape::Box { size: [0.05; 3] },
            mass: 0.1,
        }],
        parts: vec![Part { kind: 0, workspace: Agent::Person, at: [0.0; 2] }; 2],
        subgoals: vec![subgoal("lid", true, vec![]), subgoal("hinge", false, vec![0])],
        choices: Vec::new(),
        grips: vec![PersonGrip { name: "top".into(), pitch: -1.5 }],
        gestures: Vec::new(),
        acts: vec![Act::Rest, Act::Grasp { grip: 0, kind: 0 }],
        chains: vec![chain("mount", "steady"), chain("pass", "receive")],
        actions: vec![
            action("steady", ActionType::Steady, 0, "lid"),
            action("receive", ActionType::Receive, 1, "hinge"),
            action("request", ActionType::Request, 1, "hinge"),
            action("object", ActionType::Speak, 1, "hinge"),
            action("give", ActionType::Give, 1, "hinge"),
        ],
        scene: Scene {
            table_height: 0.0,
            table_centre: [0.0; 2],
            table_size: [1.0; 2],
            platform: [0.0; 3],
            platform_radius: 0.1,
            platform_height: 0.1,
            steady: vec![[0.0; 3]],
            handover: [0.0; 3],
            person_rest: [0.0; 3],
            person_shoulder: [0.0; 3],
            workspace: [[[0.0; 2]; 2]; 2],
            fit: coact_joint_task::Fit { position: 0.01, angle: 0.2 },
        },
        fingerprint: 42,
    }
}

/// Goals of the intention layer: mounting the hinge, and mounting the lid.
pub fn intentions() -> Intentions {
    Intentions::new([("mount: hinge".into(), vec![(0, 1)]), ("mount: lid".into(), vec![(0, 0)])])
}

const LAYERS: [(LayerKind, u32); 3] =
    [(LayerKind::SubgoalsAchieved, 2), (LayerKind::Intention, 2), (LayerKind::ActionExecution, 5)];

/// A frame of the network of [`task`] at rest.
pub fn frame(cycle: u64) -> Box<FieldFrame> {
    let mut frame: Box<FieldFrame> = bytemuck::zeroed_box();
    frame.header.cycle = cycle;
    frame.task = 42;
    frame.decision.action = NONE;
    frame.layers.count = LAYERS.len() as u32;
    let mut first = 0;
    for (index, (kind, populations)) in LAYERS.into_iter().enumerate() {
        frame.layers.kind[index] = kind as u32;
        frame.layers.first_population[index] = first;
        frame.layers.populations[index] = populations;
        first += populations;
    }
    frame
}

/// The same with a peak in the action execution layer, and so with a decision.
pub fn decided(cycle: u64, action: usize, since: u64) -> Box<FieldFrame> {
    let mut frame = with_peak(cycle, LayerKind::ActionExecution, action, since);
    (frame.decision.action, frame.decision.since) = (action as u32, since);
    frame
}

/// The same with a peak in one population of a layer.
pub fn with_peak(cycle: u64, layer: LayerKind, population: usize, since: u64) -> Box<FieldFrame> {
    let mut frame = frame(cycle);
    let population = frame.populations(layer).nth(population).expect("the layer has that population");
    frame.since[population] = since;
    frame
}

/// The partner's action number `number`, begun at `onset`, grasped at `grasp` (0: not yet).
pub fn acting(cycle: u64, number: u32, chain: u32, subgoal: u32, onset: u64, grasp: u64) -> Truth {
    let mut truth: Truth = bytemuck::Zeroable::zeroed();
    truth.header.cycle = cycle;
    truth.phase = if grasp == 0 { PartnerPhase::Reach } else { PartnerPhase::Transport } as u32;
    (truth.actions, truth.chain, truth.subgoal) = (number, chain, subgoal);
    (truth.onset_cycle, truth.grasp_cycle) = (onset, grasp);
    truth
}

/// The partner at rest after that action.
pub fn resting(cycle: u64, last: &Truth) -> Truth {
    let mut truth = *last;
    truth.header.cycle = cycle;
    truth.phase = PartnerPhase::Idle as u32;
    truth
}

/// Limits of an arm: 2 rad/s, 10 rad/s², half a turn to each side.
pub fn arm_limits() -> Vec<JointLimits> {
    let limits =
        JointLimits { lower: -3.0, upper: 3.0, velocity: 2.0, effort: 50.0, acceleration: 10.0, jerk: 200.0 };
    vec![limits; ARM_JOINTS]
}

/// The sensor sample of a cycle in which the first joint moves at `speed`, rad/s.
pub fn moving(cycle: u64, speed: f64) -> Box<SensorSample> {
    let mut sample: Box<SensorSample> = bytemuck::zeroed_box();
    sample.header.cycle = cycle;
    sample.header.sensor_ns = (cycle + 1) * PERIOD_NS;
    sample.joints.velocity[0] = speed;
    sample
}

/// Cycle number `cycle` of a process: due at its release, started `late_ns` later, done 100 µs after.
pub fn pulse(cycle: u64, late_ns: u64) -> Pulse {
    let mut pulse = Pulse { released_ns: (cycle + 1) * PERIOD_NS, ..Pulse::default() };
    (pulse.header.cycle, pulse.header.sequence) = (cycle, cycle);
    pulse.scheduled_ns = pulse.released_ns;
    pulse.started_ns = pulse.scheduled_ns + late_ns;
    pulse.header.published_ns = pulse.started_ns + 100_000;
    pulse.header.sensor_ns = pulse.released_ns - 50_000;
    pulse.input_published_ns = pulse.released_ns - 30_000;
    pulse.input_received_ns = pulse.released_ns;
    pulse
}

/// Measures distances of the shipped robot.
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
pub fn separation_meter() -> coact_separation::SeparationMeter {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config");
    let robot =
        coact_robot::Robot::load(std::path::Path::new(&format!("{folder}/robots/aros.toml"))).unwrap();
    let limits =
        coact_safety::SafetyLimits::load(std::path::Path::new(&format!("{folder}/safety.toml"))).unwrap();
    coact_separation::SeparationMeter::new(&robot, &limits).unwrap()
}
