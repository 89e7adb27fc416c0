use crate::{Channel, LayerPlan, NetworkPlan, Pool, Synapse};
use coact_messages::LayerKind;
use coact_neural_field::sigmoid;

/// Passes over all layers until feedback has settled. Each carries signals through the layers in their order; what feeds
/// back takes one more for each step. Chosen by hand.
const PASSES: usize = 8;
/// Layers in which one peak stands.
const DECIDE: [LayerKind; 4] = [
    LayerKind::ActionSimulation,
    LayerKind::Intention,
    LayerKind::ErrorMonitoring,
    LayerKind::ActionExecution,
];

/// Input of every population of a network under a constant percept, once all layers have settled: sums over the
/// synapse table, in units of each ignition threshold.
///
/// Where several populations of a decision layer could ignite, the one with the strongest input stands; layers without
/// interaction follow their input; all others hold a peak wherever the input ignites one.
pub(super) struct SteadyState<'a> {
    plan: &'a NetworkPlan,
    /// Synapses of each population, in the order of the plan: those of one rule side by side.
    incoming: Vec<Vec<Synapse>>,
}

/// The strongest input of a layer, and the strongest of the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Race {
    pub winner: usize,
    pub input: f64,
    pub loser: usize,
    pub ratio: f64,
}

impl<'a> SteadyState<'a> {
    pub fn of(plan: &'a NetworkPlan) -> Self {
        let mut incoming = vec![Vec::new(); plan.populations.len()];
        for synapse in &plan.synapses {
            incoming[synapse.to].push(*synapse);
        }
        Self { plan, incoming }
    }

    /// Input of each population while the channels have the values of `percept`.
    pub fn inputs(&self, percept: impl Fn(Channel) -> f64) -> Vec<f64> {
        let populations = self.plan.populations.len();
        let mut signal = vec![0.0; populations];
        signal.extend(self.plan.channels.iter().map(|plan| percept(plan.channel)));
        let mut inputs = vec![0.0; populations];
        for _ in 0..PASSES {
            for layer in &self.plan.layers {
                for population in layer.populations.clone() {
                    inputs[population] = self.input(population, &signal);
                }
                respond(layer, &inputs, &mut signal);
            }
        }
        inputs
    }

    fn input(&self, population: usize, signal: &[f64]) -> f64 {
        let rules = self.incoming[population].chunk_by(|one, other| one.rule == other.rule);
        let pooled = |group: &[Synapse]| {
            let signals = group.iter().map(|synapse| signal[synapse.from]);
            match self.plan.pools[group[0].rule] {
                Pool::Sum => group.iter().map(|synapse| synapse.weight * signal[synapse.from]).sum(),
                Pool::Absent => {
                    group.iter().map(|synapse| synapse.weight * (1.0 - signal[synapse.from])).sum()
                }
                Pool::Any => group[0].weight * signals.fold(0.0, f64::max),
                Pool::Every => group[0].weight * signals.fold(1.0, f64::min),
            }
        };
        rules.map(pooled).sum()
    }

    /// Who wins in `layer`, and how near the next one is; none where nothing ignites.
    pub fn race(&self, layer: LayerKind, inputs: &[f64]) -> Option<Race> {
        let mut order: Vec<usize> = self.plan.layer(layer).populations.clone().collect();
        order.sort_by(|&a, &b| inputs[b].total_cmp(&inputs[a]));
        let (&winner, &loser) = (order.first()?, order.get(1)?);
        let input = inputs[winner];
        (input >= 1.0).then(|| Race { winner, input, loser, ratio: inputs[loser] / input })
    }
}

fn respond(layer: &LayerPlan, inputs: &[f64], signal: &mut [f64]) {
    let strongest = layer.populations.clone().max_by(|&a, &b| inputs[a].total_cmp(&inputs[b]));
    for population in layer.populations.clone() {
        let ignites = inputs[population] >= 1.0;
        let stands = if layer.parameters.kernel.amplitude == 0.0 {
            let activity = layer.resting + layer.gain * inputs[population];
            (2.0 * sigmoid(activity, layer.parameters.slope, layer.parameters.threshold) - 1.0).max(0.0)
        } else if DECIDE.contains(&layer.kind) {
            f64::from(u8::from(ignites && strongest == Some(population)))
        } else {
            f64::from(u8::from(ignites))
        };
        signal[population] = stands;
    }
}
