use crate::rule::Connection;
use crate::sublayers::Sublayers;
use crate::{Demonstration, Order};
use coact_joint_task::NetworkPlan;
use coact_neural_field::ParameterError;

/// How long the fields go on after the last change, ms: longer than a change of the construction echoes in them.
const ECHO: u64 = 400;
/// A longer pause between two changes is cut to this, ms: memories sustain themselves, and nothing is learned meanwhile.
const PAUSE: u64 = 1000;

/// Learns by demonstration which step of a task needs which (chapter, section 7).
pub struct SerialOrder {
    sublayers: Sublayers,
    subgoals: usize,
    /// From each memorised subgoal (row) to each newly achieved one.
    connections: Vec<Connection>,
}

impl SerialOrder {
    /// Knows nothing yet; fields with the constants of `plan`.
    ///
    /// # Errors
    /// A constant with which no field can be made.
    pub fn new(plan: &NetworkPlan) -> Result<Self, ParameterError> {
        let subgoals = plan.populations_of(coact_messages::LayerKind::SubgoalsAchieved).len();
        Ok(Self {
            sublayers: Sublayers::new(plan)?,
            subgoals,
            connections: vec![Connection::NEW; subgoals * subgoals],
        })
    }

    /// Watches one demonstration, in which every subgoal comes about.
    pub fn watch(&mut self, demonstration: &Demonstration) {
        self.sublayers.rest();
        let mut seen = vec![false; self.subgoals];
        for (index, step) in demonstration.steps.iter().enumerate() {
            seen[step.subgoal] = true;
            let next = demonstration.steps.get(index + 1);
            let pause = next.map_or(ECHO, |next| (next.at_ms - step.at_ms).min(PAUSE));
            (0..pause).for_each(|_| self.step(&seen));
        }
    }

    fn step(&mut self, seen: &[bool]) {
        self.sublayers.step(seen);
        let (memorised, achieved) = self.sublayers.signals();
        for (target, &achieved) in achieved.iter().enumerate().filter(|(_, achieved)| **achieved > 0.0) {
            for (source, &memorised) in memorised.iter().enumerate().filter(|(source, _)| *source != target) {
                self.connections[source * self.subgoals + target].learn(memorised, achieved);
            }
        }
    }

    /// What the strengths say so far.
    pub fn order(&self) -> Order {
        let strengths = self.connections.iter().map(|connection| connection.weight).collect();
        Order::new(self.subgoals, strengths)
    }
}
