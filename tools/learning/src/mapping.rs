use crate::layer::Layer;
use crate::outcomes::{Outcome, Outcomes};
use coact_joint_task::{NetworkPlan, Task};
use coact_messages::{FieldFrame, LayerKind, Percept};
use coact_neural_field::ParameterError;

/// How long a success is replayed, ms, and the strength with which it activates its chain, in ignition thresholds.
const REPLAY: u32 = 200;
const TEACHES: f64 = 1.5;
/// How fast a connection follows the trace of its act, per ms of a full peak.
const LEARN: f64 = 0.005;
/// Of the acts that were observed, those with less than this share of the strongest did not show the chain.
const SHOWN: f64 = 0.5;
/// Least trace of an act that was observed at all.
const OBSERVED: f64 = 0.3;

/// Learns which observed act shows which chain of the person (chapter, section 7; Erlhagen, Mukovskiy, Bicho 2006).
///
/// The rule correlates three things: the trace x of an act in AOL, the activity c of a chain in ASL, and success. What
/// a chain was is known only by its outcome: when the part has come to a place or hand that somebody wanted, the
/// outcome activates its chain in a field with ASL's constants, and while its peak stands the weights follow the trace,
///
/// ```text
/// dw/dt = LEARN success c (x - w)
/// ```
///
/// Acts with a part connect to chains with the same kind of part only; gestures connect to all.
pub struct Mapping {
    task: Task,
    plan: NetworkPlan,
    simulation: Layer,
    outcomes: Outcomes,
    /// Of each act (row) to each chain.
    weights: Vec<f64>,
    successes: Vec<u32>,
}

/// A learned connection.
#[derive(Debug, Clone, PartialEq)]
pub struct Connection {
    /// Label of the act in AOL.
    pub act: String,
    /// Label of the chain in ASL.
    pub chain: String,
    /// Strength, in units of the ignition threshold.
    pub weight: f64,
    /// Successes of that chain; 0 when it was carried over from other kinds of part.
    pub successes: u32,
}

impl Mapping {
    /// Knows nothing yet; a field with ASL's constants in `plan`.
    ///
    /// # Errors
    /// A constant with which no field can be made.
    pub fn new(task: &Task, plan: &NetworkPlan) -> Result<Self, ParameterError> {
        let simulation = Layer::new(plan.layer(LayerKind::ActionSimulation), plan.sites_per_population)?;
        Ok(Self {
            simulation,
            outcomes: Outcomes::new(task),
            weights: vec![0.0; task.acts.len() * task.chains.len()],
            successes: vec![0; task.chains.len()],
            task: task.clone(),
            plan: plan.clone(),
        })
    }

    /// Another construction begins: what was under way is forgotten, what was learned is not.
    pub fn begin(&mut self) {
        self.outcomes = Outcomes::new(&self.task);
    }

    /// Watches one ms: what AOL observes, and what is perceived to come of it.
    pub fn watch(&mut self, tick: u64, frame: &FieldFrame, percept: &Percept) {
        let observed = &frame.signal[self.plan.layer(LayerKind::ActionObservation).populations.clone()];
        for outcome in self.outcomes.observe(tick, &self.task, observed, percept) {
            self.succeed(&outcome);
        }
    }

    fn succeed(&mut self, outcome: &Outcome) {
        let Outcome { kind, from, side, .. } = *outcome;
        for chain in 0..self.task.chains.len() {
            let own = &self.task.chains[chain];
            if (own.kind, own.from, own.side) == (kind, from, side)
                && let Some(shown) = self.shown(chain, &outcome.trace)
            {
                self.replay(chain, &shown);
            }
        }
    }

    /// How far each act showed the chain, 1 for the one that did most; none when no act was observed that could.
    fn shown(&self, chain: usize, trace: &[f64]) -> Option<Vec<f64>> {
        let possible = |act: usize| if self.connects(act, chain) { trace[act] } else { 0.0 };
        let strongest = (0..trace.len()).map(possible).fold(0.0, f64::max);
        let share =
            |act: usize| Some(possible(act) / strongest).filter(|share| *share >= SHOWN).unwrap_or(0.0);
        (strongest >= OBSERVED).then(|| (0..trace.len()).map(share).collect())
    }

    fn connects(&self, act: usize, chain: usize) -> bool {
        let acts = self.plan.populations_of(LayerKind::ActionObservation);
        match acts[act].role {
            "grasp" => acts[act].kind == Some(self.task.chains[chain].kind),
            role => role == "gesture",
        }
    }

    fn replay(&mut self, chain: usize, shown: &[f64]) {
        let chains = self.task.chains.len();
        let mut teacher = vec![0.0; chains];
        teacher[chain] = TEACHES;
        self.simulation.rest();
        self.successes[chain] += 1;
        for _ in 0..REPLAY {
            self.simulation.step(&teacher);
            for (act, shown) in shown.iter().enumerate() {
                for (chain, activity) in self.simulation.signal.iter().enumerate() {
                    let weight = &mut self.weights[act * chains + chain];
                    *weight += LEARN * activity * (shown - *weight);
                }
            }
        }
    }

    /// Successes of all chains so far.
    pub fn successes(&self) -> u32 {
        self.successes.iter().sum()
    }

    /// All connections of some strength, with the strength that the network file allows them: that of the connection
    /// that they replace. A chain that was never seen with its kind of part gets what the same chain has with others.
    pub fn connections(&self) -> Vec<Connection> {
        let (acts, chains) = (self.task.acts.len(), self.task.chains.len());
        let pairs = (0..chains).flat_map(|chain| (0..acts).map(move |act| (act, chain)));
        let connection = |(act, chain): (usize, usize)| {
            let share = self.share(act, chain)?;
            let label = |layer, index: usize| self.plan.populations_of(layer)[index].label.clone();
            let weight = self.ceiling(act) * share;
            (weight >= 0.05).then(|| Connection {
                act: label(LayerKind::ActionObservation, act),
                chain: label(LayerKind::ActionSimulation, chain),
                weight,
                successes: self.successes[chain],
            })
        };
        pairs.filter_map(connection).collect()
    }

    fn share(&self, act: usize, chain: usize) -> Option<f64> {
        let weight = |act: usize, chain: usize| self.weights[act * self.task.chains.len() + chain];
        if !self.connects(act, chain) {
            return None;
        }
        if self.successes[chain] > 0 {
            return Some(weight(act, chain));
        }
        let kin = (0..self.task.chains.len()).filter(|&other| {
            self.task.chains[other].name == self.task.chains[chain].name && self.successes[other] > 0
        });
        let weights: Vec<f64> = kin
            .filter_map(|other| Some(weight(self.same_act(act, self.task.chains[other].kind)?, other)))
            .collect();
        (!weights.is_empty()).then(|| weights.iter().sum::<f64>() / weights.len() as f64)
    }

    /// The act of the same grip with another kind of part; a gesture is the same with all.
    fn same_act(&self, act: usize, kind: usize) -> Option<usize> {
        let acts = self.plan.populations_of(LayerKind::ActionObservation);
        match acts[act].role {
            "grasp" => acts.iter().position(|other| {
                (other.role, other.grip, other.kind) == ("grasp", acts[act].grip, Some(kind))
            }),
            _ => Some(act),
        }
    }

    fn ceiling(&self, act: usize) -> f64 {
        let plan = &self.plan;
        let role = plan.populations_of(LayerKind::ActionObservation)[act].role;
        let given = plan
            .synapses
            .iter()
            .filter(|synapse| plan.shows_a_chain(synapse) && plan.populations[synapse.from].role == role);
        given.map(|synapse| synapse.weight).fold(0.0, f64::max)
    }
}
