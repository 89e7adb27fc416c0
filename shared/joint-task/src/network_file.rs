//! The network file as it is written.

use crate::{Agent, Pool, Role, task_file::Name};
use serde::Deserialize;
use toml::Spanned;

/// Shortest time scale of a layer, ms: explicit Euler steps of one period follow a field's equation as long as they are at
/// most a twentieth of tau, for slopes of the sigmoid about 5.
pub(crate) const LEAST_TAU: f64 = 20.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct NetworkFile {
    pub sites: SitesEntry,
    pub undue: Spanned<f64>,
    pub destinations: Spanned<SelectionEntry>,
    pub grips: Spanned<SelectionEntry>,
    pub layer: Vec<LayerEntry>,
    pub synapse: Vec<RuleEntry>,
    #[serde(default)]
    pub forgetting: Vec<RuleEntry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SitesEntry {
    pub per_population: Spanned<usize>,
    pub spacing: f64,
    pub input_sigma: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SelectionEntry {
    pub tau: f64,
    pub h: f64,
    pub slope: f64,
    pub gain: f64,
    pub spacing: [f64; 2],
    pub input_sigma: [f64; 2],
    pub excitation: ExcitationEntry,
    pub inhibition: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ExcitationEntry {
    pub strength: f64,
    pub sigma: [f64; 2],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LayerEntry {
    pub name: Name,
    pub tau: f64,
    pub h: Spanned<f64>,
    pub slope: f64,
    #[serde(default)]
    pub threshold: f64,
    pub gain: f64,
    #[serde(default)]
    pub noise: f64,
    pub kernel: KernelEntry,
    pub forgets: Option<ForgetsEntry>,
}

#[derive(Deserialize, Clone, Copy)]
#[serde(deny_unknown_fields)]
pub(crate) struct KernelEntry {
    pub amplitude: f64,
    pub sigma: f64,
    pub inhibition: f64,
    pub range: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ForgetsEntry {
    pub h_min: f64,
    pub r_min: f64,
    pub r_max: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RuleEntry {
    pub from: Selector,
    pub to: Selector,
    #[serde(default)]
    pub same: Vec<Attribute>,
    #[serde(default)]
    pub unlike: Vec<Attribute>,
    pub relation: Option<Relation>,
    #[serde(default)]
    pub pool: Pool,
    #[serde(default)]
    pub weight: f64,
    pub times: Option<Times>,
    #[serde(default)]
    pub why: String,
}

/// Which populations or channels a rule speaks of.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Selector {
    pub layer: Name,
    pub role: Option<Role>,
    pub side: Option<Agent>,
    pub workspace: Option<Agent>,
    pub steadied: Option<bool>,
}

/// What two populations may have in common.
#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Attribute {
    Act,
    Kind,
    Grip,
    Gesture,
    Subgoal,
    Side,
    Workspace,
    Chain,
}

/// What a rule's weight is multiplied by.
#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Times {
    /// How many of what the target's choice offers are enough; 1 for what is no choice.
    Count,
}

/// A relation that the task itself defines.
#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Relation {
    /// The plan puts the source's subgoal before the target's.
    Before,
    /// The source's subgoal is one of those that the target's choice offers.
    Offered,
    /// The source's choice, once it is made, spares the target's subgoal.
    Spares,
    /// The source's chain names the target's rule as its answer.
    Answers,
}
