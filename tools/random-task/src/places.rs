//! Where parts lie, and where they go: places on the table of `frame.toml`, m, that hands reach.

use coact_joint_task::Agent;
use rand::RngExt;
use rand_pcg::Pcg32;

/// So many steps a task has at most.
pub(crate) const MOST_PLACES: usize = 50;
/// So many parts the robot can reach at first: its fingers need 0.1 m between neighbours.
pub(crate) const ROBOT_PARTS: usize = 9;

/// Where the robot's parts lie: a grid of so many columns, its first place, and the distance between places.
const ROBOT_GRID: Grid = Grid { columns: 3, first: [-0.54, 0.48], step: [0.11, 0.13], jitter: 0.007 };
/// The person's: she reaches between parts that are 6 cm apart.
const PERSON_GRID: Grid = Grid { columns: 4, first: [-1.09, -0.16], step: [0.063, 0.068], jitter: 0.0015 };
/// Towers that the robot builds: its fingers, and what they carry, pass between them.
const ROBOT_TOWERS: Grid = Grid { columns: 4, first: [-0.62, 0.16], step: [0.09, 0.10], jitter: 0.0 };
/// Towers that the person builds.
const PERSON_TOWERS: Grid = Grid { columns: 2, first: [-0.83, -0.02], step: [0.08, 0.08], jitter: 0.0 };

/// Places of the person's grid, those under her resting hand among them.
const PERSON_PLACES: usize = 48;
/// Where her wrist rests in `frame.toml`, and how far her hand takes up the table from there, m.
const RESTING_WRIST: [f64; 2] = [-1.22, 0.20];
const RESTING_HAND: f64 = 0.20;
/// Towers of the robot: those behind them lie among its parts.
const ROBOT_TOWER_COUNT: usize = 12;
/// Towers of the person.
const PERSON_TOWER_COUNT: usize = 14;

struct Grid {
    columns: usize,
    first: [f64; 2],
    step: [f64; 2],
    jitter: f64,
}

impl Grid {
    fn at(&self, index: usize) -> [f64; 2] {
        let cell = [index % self.columns, index / self.columns];
        [0, 1].map(|axis| self.first[axis] + cell[axis] as f64 * self.step[axis])
    }

    fn near(&self, index: usize, random: &mut Pcg32) -> [f64; 2] {
        self.at(index).map(|coordinate| coordinate + random.random_range(-1.0..=1.0) * self.jitter)
    }
}

/// The places for parts in an agent's workspace.
pub(crate) fn part_places(agent: Agent, random: &mut Pcg32) -> Vec<[f64; 2]> {
    match agent {
        Agent::Person => (0..PERSON_PLACES)
            .filter(|&index| !is_under_hand(PERSON_GRID.at(index)))
            .map(|index| PERSON_GRID.near(index, random))
            .collect(),
        Agent::Robot => (0..ROBOT_PARTS).map(|index| ROBOT_GRID.near(index, random)).collect(),
    }
}

fn is_under_hand(place: [f64; 2]) -> bool {
    (place[0] - RESTING_WRIST[0]).hypot(place[1] - RESTING_WRIST[1]) < RESTING_HAND
}

/// How many towers an agent builds.
pub(crate) fn towers(agent: Agent) -> usize {
    match agent {
        Agent::Person => PERSON_TOWER_COUNT,
        Agent::Robot => ROBOT_TOWER_COUNT,
    }
}

/// Where the `index`-th of them stands.
pub(crate) fn tower(agent: Agent, index: usize) -> [f64; 2] {
    match agent {
        Agent::Person => PERSON_TOWERS.at(index),
        Agent::Robot => ROBOT_TOWERS.at(index),
    }
}
