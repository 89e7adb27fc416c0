use coact_joint_task::{Agent, Task};
use coact_messages::{Percept, ROBOT};
use coact_period::cycles;
use std::time::Duration;

/// Evidence from which something counts as perceived: the middle between surely not and surely.
const PERCEIVED: f64 = 0.5;
/// A part that changes hands is in both, or in none, for less than this.
///
/// Chosen by hand; untested with slower partners.
const HANDOVER: u64 = cycles(Duration::from_millis(1000));
/// Time constant with which the trace of an observed act decays, cycles.
///
/// Chosen by hand: about as long as the answer to an act takes.
const TRACE_DECAY: f64 = cycles(Duration::from_millis(2000)) as f64;

/// A chain that was seen to succeed, and how strongly each act was observed when it began.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Success {
    pub kind: usize,
    pub from: Agent,
    pub side: Agent,
    pub trace: Vec<f64>,
}

/// Follows the parts, as perceived: who takes one from where, and whether it gets to a hand or place that needs it.
///
/// Where the part came from and where it got to name the chain; the acts that were observed when the part left its place
/// are those that can have shown it.
pub(crate) struct SuccessDetector {
    trace: Vec<f64>,
    parts: Vec<PartHistory>,
    achieved: Vec<bool>,
}

/// Where the part of a kind has been that was taken last.
#[derive(Debug, Clone, Default)]
struct PartHistory {
    /// Who took it, and the trace of all acts then.
    origin: Option<(Agent, Vec<f64>)>,
    held: [bool; 2],
    /// Cycle in which each last held it.
    last_held: [Option<u64>; 2],
    /// Cycle in which one was last seen to lie free in the robot's workspace.
    free_before_robot: Option<u64>,
}

impl SuccessDetector {
    pub fn new(task: &Task) -> Self {
        Self {
            trace: vec![0.0; task.acts.len()],
            parts: vec![PartHistory::default(); task.kinds.len()],
            achieved: vec![false; task.subgoals.len()],
        }
    }

    /// What succeeded in this cycle; `observed` is the signal of each act in AOL.
    pub fn observe(&mut self, tick: u64, task: &Task, observed: &[f64], percept: &Percept) -> Vec<Success> {
        for (trace, &signal) in self.trace.iter_mut().zip(observed) {
            *trace = signal.max(*trace * (1.0 - 1.0 / TRACE_DECAY));
        }
        let mut successes = Vec::new();
        for kind in 0..self.parts.len() {
            successes.extend(self.follow(tick, kind, percept));
        }
        for goal in 0..self.achieved.len() {
            let now = percept.achieved[goal] > PERCEIVED;
            if now && !self.achieved[goal] {
                successes.extend(self.inserted(task, goal));
            }
            self.achieved[goal] = now;
        }
        successes
    }

    /// Notes whose hand holds a part of this kind now; handovers that begin in this cycle.
    fn follow(&mut self, tick: u64, kind: usize, percept: &Percept) -> Vec<Success> {
        let held = [percept.robot_holds[kind], percept.person_holds[kind]].map(|held| held > PERCEIVED);
        let new = |agent: &Agent| held[agent.index()] && !self.parts[kind].held[agent.index()];
        let takers: Vec<Agent> = [Agent::Robot, Agent::Person].into_iter().filter(new).collect();
        let handed = takers.into_iter().filter_map(|agent| self.taken(tick, kind, agent)).collect();
        let part = &mut self.parts[kind];
        part.held = held;
        for (last, held) in part.last_held.iter_mut().zip(held) {
            *last = if held { Some(tick) } else { *last };
        }
        if percept.workspace[ROBOT].seen[kind] > PERCEIVED {
            part.free_before_robot = Some(tick);
        }
        handed
    }

    /// A part comes into somebody's hand: out of the other's, which is a success, or from where it lay.
    fn taken(&mut self, tick: u64, kind: usize, by: Agent) -> Option<Success> {
        let other = if by == Agent::Robot { Agent::Person } else { Agent::Robot };
        let part = &mut self.parts[kind];
        let recent = |at: Option<u64>| at.is_some_and(|at| tick.saturating_sub(at) < HANDOVER);
        let own = by == Agent::Robot && recent(part.free_before_robot);
        let handed = recent(part.last_held[other.index()]) && !own;
        let origin = part.origin.replace((by, self.trace.clone()));
        let (from, trace) = origin.filter(|(from, _)| handed && *from == other)?;
        Some(Success { kind, from, side: by, trace })
    }

    /// A part comes into its place on the person's side.
    fn inserted(&mut self, task: &Task, goal: usize) -> Option<Success> {
        let subgoal = &task.subgoals[goal];
        let (from, trace) = self.parts[subgoal.kind].origin.take()?;
        (subgoal.side == Agent::Person).then_some(Success {
            kind: subgoal.kind,
            from,
            side: subgoal.side,
            trace,
        })
    }
}
