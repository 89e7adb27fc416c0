//! Where parts lie, and where they go: places on the table of `frame.toml`, m, that hands reach.

use coact_joint_task::Agent;
use rand::RngExt;
use rand_pcg::Pcg32;

/// So many steps a task has at most.
pub(crate) const MOST_PLACES: usize = 50;
/// Where the robot's parts lie at first: its fingers need 0.1 m between neighbours.
const ROBOT_GRID: Grid =
    Grid { columns: 3, places: 9, first: [-0.54, 0.48], step: [0.11, 0.13], jitter: 0.007 };
/// The person's, those under her resting hand among them: she reaches between parts that are 6 cm apart.
const PERSON_GRID: Grid =
    Grid { columns: 4, places: 48, first: [-1.09, -0.16], step: [0.063, 0.068], jitter: 0.0015 };
/// Towers that the robot builds: its fingers, and what they carry, pass between them. Those behind them would stand among its parts.
const ROBOT_TOWERS: Grid =
    Grid { columns: 4, places: 12, first: [-0.62, 0.16], step: [0.09, 0.10], jitter: 0.0 };
/// Towers that the person builds.
const PERSON_TOWERS: Grid =
    Grid { columns: 2, places: 14, first: [-0.83, -0.02], step: [0.08, 0.08], jitter: 0.0 };

/// Where the person's wrist rests in `frame.toml`, and how far her hand takes up the table from there, m.
const RESTING_WRIST: [f64; 2] = [-1.22, 0.20];
const RESTING_HAND: f64 = 0.20;

/// Places in rows, each moved at random by up to `jitter`, m.
struct Grid {
    columns: usize,
    places: usize,
    first: [f64; 2],
    step: [f64; 2],
    jitter: f64,
}

impl Grid {
    fn places(&self) -> impl Iterator<Item = [f64; 2]> {
        (0..self.places).map(|index| {
            let cell = [index % self.columns, index / self.columns];
            [0, 1].map(|axis| self.first[axis] + cell[axis] as f64 * self.step[axis])
        })
    }
}

/// The places for parts in an agent's workspace.
pub(crate) fn part_places(agent: Agent, random: &mut Pcg32) -> Vec<[f64; 2]> {
    let grid = match agent {
        Agent::Person => PERSON_GRID,
        Agent::Robot => ROBOT_GRID,
    };
    let free = grid.places().filter(|place| !is_under_hand(*place));
    free.map(|place| place.map(|length| length + random.random_range(-1.0..=1.0) * grid.jitter)).collect()
}

/// Where an agent builds towers.
pub(crate) fn tower_places(agent: Agent) -> Vec<[f64; 2]> {
    let grid = match agent {
        Agent::Person => PERSON_TOWERS,
        Agent::Robot => ROBOT_TOWERS,
    };
    grid.places().collect()
}

fn is_under_hand(place: [f64; 2]) -> bool {
    (place[0] - RESTING_WRIST[0]).hypot(place[1] - RESTING_WRIST[1]) < RESTING_HAND
}
