use coact_joint_task::{Agent, Task};
use coact_messages::{Percept, ROBOT};

/// Evidence from which something counts as perceived.
const PERCEIVED: f64 = 0.5;
/// A part that changes hands is in both, or in none, for less than this, ms.
const CHANGES_HANDS: u64 = 1000;
/// Time in which the trace of an observed act decays, ms: as long as an answer to it takes.
const TRACE: f64 = 2000.0;

/// A chain that was seen to succeed, and how strongly each act was observed when it began.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Outcome {
    pub kind: usize,
    pub from: Agent,
    pub side: Agent,
    pub trace: Vec<f64>,
}

/// Watches what becomes of parts, as perceived: who takes one where, and whether it gets to a hand or place that
/// somebody wanted. The outcome names the chain; the acts that were observed when the part left its place are those
/// that can have shown it.
pub(crate) struct Outcomes {
    trace: Vec<f64>,
    parts: Vec<Way>,
    achieved: Vec<bool>,
}

/// The way of a kind of part.
#[derive(Debug, Clone, Default)]
struct Way {
    /// In whose workspace or hand it began, and the trace then.
    origin: Option<(Agent, Vec<f64>)>,
    held: [bool; 2],
    /// When each last held it, ms.
    last: [Option<u64>; 2],
    /// When one was last seen to lie free in the robot's workspace, ms.
    with_the_robot: Option<u64>,
}

impl Outcomes {
    pub fn new(task: &Task) -> Self {
        Self {
            trace: vec![0.0; task.acts.len()],
            parts: vec![Way::default(); task.kinds.len()],
            achieved: vec![false; task.subgoals.len()],
        }
    }

    /// What succeeded in this ms; `observed` is the signal of each act in AOL.
    pub fn observe(&mut self, tick: u64, task: &Task, observed: &[f64], percept: &Percept) -> Vec<Outcome> {
        for (trace, &signal) in self.trace.iter_mut().zip(observed) {
            *trace = signal.max(*trace * (1.0 - 1.0 / TRACE));
        }
        let mut outcomes = Vec::new();
        for kind in 0..self.parts.len() {
            let held = [percept.robot_holds[kind], percept.person_holds[kind]].map(|held| held > PERCEIVED);
            for agent in [Agent::Robot, Agent::Person] {
                if held[agent.index()] && !self.parts[kind].held[agent.index()] {
                    outcomes.extend(self.taken(tick, kind, agent));
                }
            }
            let way = &mut self.parts[kind];
            way.held = held;
            for (last, held) in way.last.iter_mut().zip(held) {
                *last = if held { Some(tick) } else { *last };
            }
            if percept.workspace[ROBOT].seen[kind] > PERCEIVED {
                way.with_the_robot = Some(tick);
            }
        }
        for goal in 0..self.achieved.len() {
            let now = percept.achieved[goal] > PERCEIVED;
            if now && !self.achieved[goal] {
                outcomes.extend(self.mounted(task, goal));
            }
            self.achieved[goal] = now;
        }
        outcomes
    }

    /// A part comes into somebody's hand: out of the other's, which is a success, or from where it lay.
    fn taken(&mut self, tick: u64, kind: usize, by: Agent) -> Option<Outcome> {
        let other = if by == Agent::Robot { Agent::Person } else { Agent::Robot };
        let way = &mut self.parts[kind];
        let recent = |at: Option<u64>| at.is_some_and(|at| tick.saturating_sub(at) < CHANGES_HANDS);
        let own = by == Agent::Robot && recent(way.with_the_robot);
        let handed = recent(way.last[other.index()]) && !own;
        let origin = way.origin.replace((by, self.trace.clone()));
        let (from, trace) = origin.filter(|(from, _)| handed && *from == other)?;
        Some(Outcome { kind, from, side: by, trace })
    }

    /// A part comes into its place on the person's side.
    fn mounted(&mut self, task: &Task, goal: usize) -> Option<Outcome> {
        let subgoal = &task.subgoals[goal];
        let (from, trace) = self.parts[subgoal.kind].origin.take()?;
        (subgoal.side == Agent::Person).then_some(Outcome {
            kind: subgoal.kind,
            from,
            side: subgoal.side,
            trace,
        })
    }
}
