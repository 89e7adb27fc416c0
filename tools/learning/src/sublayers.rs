use crate::layer::Layer;
use coact_joint_task::NetworkPlan;
use coact_messages::LayerKind;
use coact_neural_field::ParameterError;

/// Strength of what is seen, and of the synapses from the second sublayer to the first, in ignition thresholds: each
/// ignites its target alone. The network file has the same for what is seen to be achieved.
const EXCITATION: f64 = 1.5;
/// Strength by which a memory silences the same subgoal in the second sublayer, where the network file has none.
///
/// Chosen by hand: it outweighs [`EXCITATION`], so that no peak stands for what is memorised, though it is still seen.
const INHIBITION: f64 = -2.0;

/// The two sublayers of CSGL while a teacher demonstrates (chapter, section 7): what is seen ignites its subgoal in the
/// second; that peak ignites the same subgoal in the first, which sustains itself and silences the second.
///
/// What is seen stays in sight; the second sublayer's peak is transient all the same, by the interaction of the fields.
pub(crate) struct Sublayers {
    memory: Layer,
    change: Layer,
    /// From each memory to the same subgoal of the second sublayer.
    inhibition: Vec<f64>,
    input: Vec<f64>,
}

impl Sublayers {
    /// Fields with the constants of the layers of `plan`.
    pub fn new(plan: &NetworkPlan) -> Result<Self, ParameterError> {
        let width = plan.sites_per_population;
        let [achieved, available] =
            [LayerKind::SubgoalsAchieved, LayerKind::SubgoalsAvailable].map(|kind| plan.layer(kind));
        let own = |(from, to)| {
            let synapses = plan.synapses.iter().filter(|synapse| (synapse.from, synapse.to) == (from, to));
            let weight: f64 = synapses.map(|synapse| synapse.weight).sum();
            if weight < 0.0 { weight } else { INHIBITION }
        };
        Ok(Self {
            memory: Layer::new(achieved, width)?,
            change: Layer::new(available, width)?,
            inhibition: achieved.populations.clone().zip(available.populations.clone()).map(own).collect(),
            input: vec![0.0; achieved.populations.len()],
        })
    }

    /// Nothing is memorised: a new demonstration begins.
    pub fn rest(&mut self) {
        self.memory.rest();
        self.change.rest();
    }

    /// Advances by one period, while the subgoals that `seen` names are seen to be achieved.
    pub fn step(&mut self, seen: &[bool]) {
        for (subgoal, input) in self.input.iter_mut().enumerate() {
            let sight = EXCITATION * f64::from(u8::from(seen[subgoal]));
            *input = sight + self.inhibition[subgoal] * self.memory.signal[subgoal];
        }
        let excited = self.change.signal.iter().map(|signal| EXCITATION * signal);
        let memories: Vec<f64> = excited.collect();
        self.change.step(&self.input);
        self.memory.step(&memories);
    }

    /// Signal of each subgoal's memory, and of its transient peak.
    pub fn signals(&self) -> (&[f64], &[f64]) {
        (&self.memory.signal, &self.change.signal)
    }
}
