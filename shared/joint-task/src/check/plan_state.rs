use super::examined_task::ExaminedTask;
use crate::Agent;
use std::collections::{BTreeSet, VecDeque};

/// How many states of the plan are looked at: plans with many open branches have more than anybody would wait for.
pub(super) const MOST_STATES: usize = 2000;

/// How far a construction has come: what is achieved, and what lies where.
#[derive(Debug, Clone)]
pub(super) struct PlanState {
    /// Subgoals that are achieved, bit for bit.
    achieved: u64,
    /// Parts that lie free: by workspace and kind.
    parts: [Vec<usize>; 2],
}

impl PlanState {
    /// States that the plan allows, nearest to the start first, at most [`MOST_STATES`].
    pub fn all(examined: &ExaminedTask) -> Vec<Self> {
        let mut seen = BTreeSet::from([0_u64]);
        let mut ahead = VecDeque::from([0_u64]);
        let mut states = Vec::new();
        while let Some(achieved) = ahead.pop_front().filter(|_| states.len() < MOST_STATES) {
            let state = Self::of(examined, achieved);
            for goal in examined.subgoals().filter(|&goal| state.is_open(examined, goal)) {
                let next = achieved | 1 << goal;
                if seen.insert(next) {
                    ahead.push_back(next);
                }
            }
            states.push(state);
        }
        states
    }

    /// Each achieved subgoal took a part that lay on its own side, if there was one.
    fn of(examined: &ExaminedTask, achieved: u64) -> Self {
        let kinds = 0..examined.task.kinds.len();
        let lie = |owner: Agent| kinds.clone().map(|kind| examined.parts(kind, owner)).collect();
        let mut parts: [Vec<usize>; 2] = [lie(Agent::Robot), lie(Agent::Person)];
        for goal in examined.subgoals().filter(|goal| achieved & (1 << goal) != 0) {
            let subgoal = &examined.task.subgoals[goal];
            let own = subgoal.side.index();
            let from = if parts[own][subgoal.kind] > 0 { own } else { 1 - own };
            parts[from][subgoal.kind] = parts[from][subgoal.kind].saturating_sub(1);
        }
        Self { achieved, parts }
    }

    pub fn is_achieved(&self, goal: usize) -> bool {
        self.achieved & (1 << goal) != 0
    }

    pub fn is_open(&self, examined: &ExaminedTask, goal: usize) -> bool {
        examined.task.is_available(goal, self.achieved)
    }

    pub fn parts(&self, workspace: usize, kind: usize) -> usize {
        self.parts[workspace][kind]
    }

    /// Takes one part away from where it lies.
    pub fn take(&mut self, workspace: usize, kind: usize) {
        let parts = &mut self.parts[workspace][kind];
        *parts = parts.saturating_sub(1);
    }

    /// In words: what was achieved last would do, but its names tell most.
    pub fn describe(&self, examined: &ExaminedTask) -> String {
        let goals = examined.subgoals().filter(|&goal| self.is_achieved(goal));
        let names: Vec<_> = goals.map(|goal| examined.task.subgoals[goal].name.as_str()).collect();
        match names.len() {
            0 => "at the start".into(),
            1..=3 => format!("after {}", names.join(", ")),
            count => format!("with {count} subgoals achieved"),
        }
    }
}
