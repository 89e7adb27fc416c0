use crate::plastic_connection::PlasticConnection;
use crate::sublayers::Sublayers;
use crate::{Demonstration, LearnedOrder};
use coact_joint_task::NetworkPlan;
use coact_neural_field::ParameterError;
use coact_period::cycles;
use std::time::Duration;

/// How long the fields go on after the last change: longer than the transient peak of a change lasts, some 80 ms, with
/// the ignition of its memory. Chosen by hand; not sensitive.
const AFTER_LAST_STEP: u64 = cycles(Duration::from_millis(400));
/// A longer pause between two changes is cut to this: memories sustain themselves, and nothing is learned meanwhile.
/// Chosen by hand; not sensitive.
const LONGEST_PAUSE: u64 = cycles(Duration::from_millis(1000));

/// Learns by demonstration which step of a task needs which (chapter, section 7).
pub struct SerialOrder {
    sublayers: Sublayers,
    subgoals: usize,
    /// From each memorised subgoal (row) to each newly achieved one.
    connections: Vec<PlasticConnection>,
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
            connections: vec![PlasticConnection::NEW; subgoals * subgoals],
        })
    }

    /// Watches one demonstration, in which every subgoal comes about.
    pub fn watch(&mut self, demonstration: &Demonstration) {
        self.sublayers.rest();
        let mut seen = vec![false; self.subgoals];
        for (index, step) in demonstration.steps.iter().enumerate() {
            seen[step.subgoal] = true;
            let next = demonstration.steps.get(index + 1);
            let pause = next.map_or(AFTER_LAST_STEP, |next| (next.at_ms - step.at_ms).min(LONGEST_PAUSE));
            (0..pause).for_each(|_| self.step(&seen));
        }
        self.connections.iter_mut().for_each(PlasticConnection::learn);
    }

    fn step(&mut self, seen: &[bool]) {
        self.sublayers.step(seen);
        let (memorised, achieved) = self.sublayers.signals();
        for (target, &achieved) in achieved.iter().enumerate().filter(|(_, achieved)| **achieved > 0.0) {
            for (source, &memorised) in memorised.iter().enumerate().filter(|(source, _)| *source != target) {
                self.connections[source * self.subgoals + target].trace(memorised, achieved);
            }
        }
    }

    /// What has been learned so far.
    pub fn order(&self) -> LearnedOrder {
        let strengths = self.connections.iter().map(PlasticConnection::strength).collect();
        LearnedOrder::new(self.subgoals, strengths)
    }
}
