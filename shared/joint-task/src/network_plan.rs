use crate::{Population, SelectionPlan};
use coact_messages::LayerKind;
use coact_neural_field::{Forgetting, Parameters};
use std::ops::Range;

/// The network of a task, ready to be integrated: layers, populations and the synapse table.
///
/// Populations of all layers stand in one row, layer after layer, in the order of [`LayerKind`]; behind them stand
/// the channels of the percept. A [`Synapse`] names its ends by their place in that row.
#[derive(Debug, Clone, PartialEq)]
pub struct NetworkPlan {
    /// The field over the table that stands before the layers: a peak is where the person's hand is going.
    pub destinations: SelectionPlan,
    /// The field over the hand's pitch, rad, and the width that it opens for, m, that stands beside it: a peak is the grip.
    pub grips: SelectionPlan,
    /// Width of each kind of part, m: how wide the hand opens for it.
    pub widths: Vec<f64>,
    /// How likely a reach for a part that no available step needs is beforehand, against one for a part that is due, from 0 to 1.
    pub undue: f64,
    /// All layers, in the order of [`LayerKind`].
    pub layers: Vec<LayerPlan>,
    /// All populations, layer after layer.
    pub populations: Vec<Population>,
    /// The percept's channels.
    pub channels: Vec<ChannelPlan>,
    /// Synapses, sorted by target, then rule, then source.
    pub synapses: Vec<Synapse>,
    /// Which channel makes which memory population forget.
    pub forgetting: Vec<Synapse>,
    /// Why each rule stands in the network file, by [`Synapse::rule`].
    pub reasons: Vec<String>,
    /// How the sources that a rule finds for one target add up, by [`Synapse::rule`].
    pub pools: Vec<Pool>,
    /// Sites of each population.
    pub sites_per_population: usize,
}

/// One layer.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerPlan {
    /// Which layer it is.
    pub kind: LayerKind,
    /// Constants of its field.
    pub parameters: Parameters,
    /// Resting level h.
    pub resting: f64,
    /// K of equation 4: the input that ignites a population at rest.
    pub gain: f64,
    /// Standard deviation of each population's noise, in units of the gain.
    pub noise: f64,
    /// How it forgets, if it remembers.
    pub forgetting: Option<Forgetting>,
    /// Its populations in the row of all.
    pub populations: Range<usize>,
}

/// One channel of the percept.
#[derive(Debug, Clone, PartialEq)]
pub struct ChannelPlan {
    /// Where its value stands.
    pub channel: Channel,
    /// What it stands for.
    pub meaning: Population,
}

/// Where a channel's value stands in the percept, or, of a destination, in the fields that select; the number is the act's, kind's, grip's or
/// subgoal's index.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names are those of the percept's fields")]
pub enum Channel {
    Always,
    Act(usize),
    Hold { act: usize, grip: usize, kind: usize },
    Destination { grip: usize, kind: usize },
    BoundFor(usize),
    Seen { workspace: usize, kind: usize },
    Gone { workspace: usize, kind: usize },
    Achieved(usize),
    Open(usize),
    RobotHolds(usize),
    PersonHolds(usize),
    Lost(usize),
}

/// One connection of strength a_mj (chapter, eq. 4), in units of the target's ignition threshold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Synapse {
    /// Source: a population, or behind all populations, a channel.
    pub from: usize,
    /// Target population.
    pub to: usize,
    /// Strength.
    pub weight: f64,
    /// The rule that made it: index into [`NetworkPlan::reasons`].
    pub rule: usize,
}

/// How the sources that one rule finds for a target add up.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Pool {
    /// All of them (chapter, eq. 4).
    #[default]
    Sum,
    /// The strongest counts: they stand for the same thing, and several of them do not make it any truer.
    Any,
    /// The weakest counts: only all of them together mean something.
    Every,
    /// Each counts by what it lacks, 1 less its signal, and all of them add up: what is not there holds back, however many are.
    Absent,
}

impl Pool {
    /// As a network file has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sum => "sum",
            Self::Any => "any",
            Self::Every => "every",
            Self::Absent => "absent",
        }
    }
}

impl NetworkPlan {
    /// The layer of `kind`.
    pub fn layer(&self, kind: LayerKind) -> &LayerPlan {
        &self.layers[kind as usize]
    }

    /// The layer that the population at place `index` of the row belongs to; `None` for a channel.
    pub fn layer_of(&self, index: usize) -> Option<&LayerPlan> {
        self.layers.iter().find(|layer| layer.populations.contains(&index))
    }

    /// The populations of the layer of `kind`.
    pub fn populations_of(&self, kind: LayerKind) -> &[Population] {
        &self.populations[self.layer(kind).populations.clone()]
    }

    /// What stands at place `index` of the row of populations and channels.
    pub fn meaning(&self, index: usize) -> &Population {
        self.populations.get(index).unwrap_or_else(|| &self.channels[index - self.populations.len()].meaning)
    }

    /// Layer and label of what stands at place `index` of the row of populations and channels: as in "IL insert: wheel".
    pub fn name(&self, index: usize) -> String {
        let layer = self.layer_of(index).map_or("seen", |layer| layer.kind.name());
        format!("{layer} {}", self.meaning(index).label)
    }

    /// Population of the intention layer that stands for `chain` (index into `Task::chains`) serving `subgoal`.
    pub fn goal(&self, chain: usize, subgoal: usize) -> Option<usize> {
        let layer = self.layer(LayerKind::Intention).populations.clone();
        layer.into_iter().find(|&index| {
            let goal = &self.populations[index];
            goal.chain_index == Some(chain) && goal.subgoal == Some(subgoal)
        })
    }
}
