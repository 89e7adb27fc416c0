use crate::TaskShape;
use crate::choice::{self, Choice};
use crate::places::{part_places, tower_places};
use crate::subgoal::{Socket, Subgoal};
use coact_joint_task::Agent;
use rand::seq::{IndexedMutRandom, SliceRandom, index};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;
use serde::Serialize;

/// A task that nobody drew.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RandomTask {
    #[serde(skip)]
    name: String,
    kind: Vec<Kind>,
    part: Vec<Part>,
    subgoal: Vec<Subgoal>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    choice: Vec<Choice>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct Kind {
    name: String,
    width: f64,
    shape: Shape,
    mass: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
enum Shape {
    Cylinder { radius: f64, height: f64 },
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct Part {
    kind: String,
    workspace: &'static str,
    at: [f64; 2],
}

/// A tower that grows: the parts in it, from below, by their steps.
struct Tower {
    at: [f64; 2],
    steps: Vec<usize>,
    height: f64,
}

/// What is the same in all random tasks: words, grips, actions and table.
const FRAME: &str = include_str!("frame.toml");
/// Where towers begin, m: 2 cm above the table of `frame.toml`, as on a peg, so that a hand that holds a part by its lower half does not meet
/// the table.
const FOUNDATION: f64 = 0.82;
/// So many parts stand on each other at most: hands still pass above.
const LEVELS: usize = 3;
/// Share of the parts that lie before the robot at first, while there is room.
const BEFORE_ROBOT: f64 = 0.4;
/// Diameters of parts, m: a hand grasps one without meeting the next tower.
const DIAMETER: std::ops::Range<f64> = 0.020..0.045;
/// Heights of parts, m.
const HEIGHT: std::ops::Range<f64> = 0.030..0.050;
/// Of wood, kg/m³.
const DENSITY: f64 = 700.0;

impl RandomTask {
    /// The task of that shape and seed.
    pub fn new(shape: TaskShape, seed: u64) -> Self {
        let random = &mut Pcg32::seed_from_u64(seed);
        let kind: Vec<Kind> = (0..shape.kinds()).map(|index| Kind::random(index, random)).collect();
        let mut kinds: Vec<usize> = (0..shape.subgoals()).map(|index| shape.kind(index)).collect();
        kinds.shuffle(random);
        let mut subgoal = subgoals(shape, &kind, &kinds, random);
        kinds.shuffle(random);
        let part = parts(&kind, &kinds, random);
        let choice = choice::offer(shape.offered(), &mut subgoal, random);
        Self { name: format!("random task {seed}"), kind, part, subgoal, choice }
    }

    /// The task as a file: of `rt-config/tasks`, where the network is that it names.
    pub fn to_toml(&self) -> String {
        // Nothing in it has no form in TOML.
        format!("name = \"{}\"\n{FRAME}\n{}", self.name, toml::to_string(self).unwrap_or_default())
    }
}

impl Tower {
    fn has_room(&self) -> bool {
        self.steps.len() < LEVELS
    }
}

impl Kind {
    fn random(index: usize, random: &mut Pcg32) -> Self {
        let (width, height) =
            (millimetres(random.random_range(DIAMETER)), millimetres(random.random_range(HEIGHT)));
        let radius = width / 2.0;
        let grams = (std::f64::consts::PI * radius * radius * height * DENSITY * 1e3).round();
        Self {
            name: format!("part {}", index + 1),
            width,
            shape: Shape::Cylinder { radius, height },
            mass: grams / 1e3,
        }
    }

    fn height(&self) -> f64 {
        let Shape::Cylinder { height, .. } = self.shape;
        height
    }
}

/// A step for each of `kinds`, in an order in which they can be done.
fn subgoals(shape: TaskShape, kind: &[Kind], kinds: &[usize], random: &mut Pcg32) -> Vec<Subgoal> {
    let mut growing = [Agent::Person, Agent::Robot].map(|agent| (agent, empty_towers(agent)));
    let broadest = random.random_range(shape.predecessors()..shape.subgoals());
    let mut subgoals: Vec<Subgoal> = Vec::new();
    for (step, needed) in kinds.iter().map(|&index| &kind[index]).enumerate() {
        let mut sides: Vec<_> =
            growing.iter_mut().filter(|(_, towers)| towers.iter().any(Tower::has_room)).collect();
        let Some((agent, towers)) = sides.choose_mut(random) else { break };
        let mut free: Vec<_> = towers.iter_mut().filter(|tower| tower.has_room()).collect();
        let Some(tower) = free.choose_mut(random) else { break };
        let before = match step == broadest {
            true => shape.predecessors(),
            false => random.random_range(0..=shape.predecessors().min(step)),
        };
        let after = predecessors(step, before, tower.steps.last().copied(), random);
        subgoals.push(Subgoal {
            name: format!("step {}", step + 1),
            kind: needed.name.clone(),
            side: name(*agent),
            socket: Socket { at: [tower.at[0], tower.at[1], FOUNDATION + tower.height].map(millimetres) },
            after: after.into_iter().map(|earlier| subgoals[earlier].name.clone()).collect(),
        });
        tower.steps.push(step);
        tower.height += needed.height();
    }
    subgoals
}

fn empty_towers(agent: Agent) -> Vec<Tower> {
    tower_places(agent).into_iter().map(|at| Tower { at, steps: Vec::new(), height: 0.0 }).collect()
}

/// So many of the earlier steps, what `step` stands on among them.
fn predecessors(step: usize, count: usize, below: Option<usize>, random: &mut Pcg32) -> Vec<usize> {
    let mut after = index::sample(random, step, count.min(step)).into_vec();
    if let Some(below) = below.filter(|below| !after.contains(below)) {
        after.pop();
        after.push(below);
    }
    after.sort_unstable();
    after
}

/// A part for each of `kinds`, before one of the two.
fn parts(kind: &[Kind], kinds: &[usize], random: &mut Pcg32) -> Vec<Part> {
    let mut free = [Agent::Person, Agent::Robot].map(|agent| {
        let mut places = part_places(agent, random);
        places.shuffle(random);
        (agent, places)
    });
    let mut parts = Vec::new();
    for needed in kinds.iter().map(|&index| &kind[index]) {
        let robot = free[0].1.is_empty() || (!free[1].1.is_empty() && random.random_bool(BEFORE_ROBOT));
        let (agent, places) = &mut free[usize::from(robot)];
        let Some(place) = places.pop() else { continue };
        let at = place.map(millimetres);
        parts.push(Part { kind: needed.name.clone(), workspace: name(*agent), at });
    }
    parts
}

/// Rounded to whole mm.
fn millimetres(length: f64) -> f64 {
    (length * 1e3).round() / 1e3
}

fn name(agent: Agent) -> &'static str {
    match agent {
        Agent::Person => "person",
        Agent::Robot => "robot",
    }
}
