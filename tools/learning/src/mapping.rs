use crate::Connection;
use crate::layer::Layer;
use crate::success_detector::{Success, SuccessDetector};
use coact_joint_task::{NetworkPlan, Role, Task};
use coact_messages::{FieldFrame, LayerKind, Percept};
use coact_neural_field::ParameterError;
use coact_period::cycles;
use std::time::Duration;

/// How long a success is replayed.
///
/// Chosen by hand, together with [`LEARNING_RATE`]: in so long a full peak takes a connection 63 % of the way to the
/// trace, so that a few successes teach, and later ones outweigh a single odd one.
const REPLAY: u64 = cycles(Duration::from_millis(200));
/// Input with which a success activates its chain, in ignition thresholds.
///
/// As what is surely perceived has in the network file: clearly above 1, which ignites.
const TEACHING_INPUT: f64 = 1.5;
/// How fast a connection follows the trace of its act, per cycle of a full peak. Chosen with [`REPLAY`].
const LEARNING_RATE: f64 = 0.005;
/// Of the acts that were observed, those with less than this fraction of the strongest did not show the chain.
///
/// Chosen by hand: an act of the same strength 1.4 s earlier has fallen to half. Untested with other tasks.
const SHOWN: f64 = 0.5;
/// Least trace of an act that was observed at all: below, it is noise of the field. Chosen by hand; not sensitive.
const OBSERVED: f64 = 0.3;
/// Weakest connection that is worth writing down, in ignition thresholds. Chosen by hand: it moves no decision.
const WORTH_WRITING: f64 = 0.05;

/// Learns which observed act shows which chain of the person (chapter, section 7; Erlhagen, Mukovskiy, Bicho 2006).
///
/// The rule correlates three things: the trace x of an act in AOL, the signal c of a chain in ASL, and success. Which
/// chain it was is known only when it has succeeded: when the part has come to a place or hand that needs it, the
/// success activates its chain in a field with ASL's constants, and while its peak stands the weights follow the trace,
///
/// ```text
/// dw/dt = LEARNING_RATE success c (x - w)
/// ```
///
/// Acts with a part connect to chains with the same kind of part only; gestures connect to all.
pub struct Mapping {
    task: Task,
    plan: NetworkPlan,
    simulation: Layer,
    detector: SuccessDetector,
    /// Of each act (row) to each chain.
    weights: Vec<f64>,
    successes: Vec<u32>,
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
            detector: SuccessDetector::new(task),
            weights: vec![0.0; task.acts.len() * task.chains.len()],
            successes: vec![0; task.chains.len()],
            task: task.clone(),
            plan: plan.clone(),
        })
    }

    /// Another assembly begins: actions that have not ended are forgotten, what was learned is not.
    pub fn begin(&mut self) {
        self.detector = SuccessDetector::new(&self.task);
    }

    /// Watches one cycle: what AOL observes, and what is perceived of the parts.
    pub fn watch(&mut self, tick: u64, frame: &FieldFrame, percept: &Percept) {
        let observed = &frame.signal[self.plan.layer(LayerKind::ActionObservation).populations.clone()];
        for success in self.detector.observe(tick, &self.task, observed, percept) {
            self.succeed(&success);
        }
    }

    fn succeed(&mut self, success: &Success) {
        let Success { kind, from, side, .. } = *success;
        for chain in 0..self.task.chains.len() {
            let own = &self.task.chains[chain];
            if (own.kind, own.from, own.side) == (kind, from, side)
                && let Some(shown) = self.shown(chain, &success.trace)
            {
                self.replay(chain, &shown);
            }
        }
    }

    /// How far each act showed the chain, 1 for the one that did most; none when no act was observed that could.
    fn shown(&self, chain: usize, trace: &[f64]) -> Option<Vec<f64>> {
        let possible = |act: usize| if self.connects(act, chain) { trace[act] } else { 0.0 };
        let strongest = (0..trace.len()).map(possible).fold(0.0, f64::max);
        let fraction =
            |act: usize| Some(possible(act) / strongest).filter(|fraction| *fraction >= SHOWN).unwrap_or(0.0);
        (strongest >= OBSERVED).then(|| (0..trace.len()).map(fraction).collect())
    }

    fn connects(&self, act: usize, chain: usize) -> bool {
        let acts = self.plan.populations_of(LayerKind::ActionObservation);
        match acts[act].role {
            Role::Grasp => acts[act].kind == Some(self.task.chains[chain].kind),
            role => role == Role::Gesture,
        }
    }

    fn replay(&mut self, chain: usize, shown: &[f64]) {
        let chains = self.task.chains.len();
        let mut teacher = vec![0.0; chains];
        teacher[chain] = TEACHING_INPUT;
        self.simulation.rest();
        self.successes[chain] += 1;
        for _ in 0..REPLAY {
            self.simulation.step(&teacher);
            for (act, shown) in shown.iter().enumerate() {
                for (chain, activity) in self.simulation.signal.iter().enumerate() {
                    let weight = &mut self.weights[act * chains + chain];
                    *weight += LEARNING_RATE * activity * (shown - *weight);
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
            let fraction = self.fraction(act, chain)?;
            let label = |layer, index: usize| self.plan.populations_of(layer)[index].label.clone();
            let weight = self.ceiling(act) * fraction;
            (weight >= WORTH_WRITING).then(|| Connection {
                act: label(LayerKind::ActionObservation, act),
                chain: label(LayerKind::ActionSimulation, chain),
                weight,
                successes: self.successes[chain],
            })
        };
        pairs.filter_map(connection).collect()
    }

    /// How strong the connection is as a fraction of what the network file allows; `None` where nothing was learned.
    fn fraction(&self, act: usize, chain: usize) -> Option<f64> {
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
            Role::Grasp => acts.iter().position(|other| {
                (other.role, other.grip, other.kind) == (Role::Grasp, acts[act].grip, Some(kind))
            }),
            _ => Some(act),
        }
    }

    /// Strength of the connections that the network file gives to acts of the same role.
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
