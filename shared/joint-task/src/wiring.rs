//! From the network file's rules and a task to layers, populations and synapses.

use crate::network_file::{KernelEntry, LEAST_TAU, LayerEntry, NetworkFile};
use crate::network_plan::{LayerPlan, NetworkPlan};
use crate::percept_channels::channels;
use crate::population::{Population, populations};
use crate::selection_fields::{destination_field, grip_field};
use crate::source_file::SourceFile;
use crate::synapse_rules::SynapseRules;
use crate::{Task, TaskError};
use coact_messages::{LayerKind, MAX_POPULATIONS, MAX_SITES};
use coact_neural_field::{Forgetting, Kernel, Parameters};
use std::hash::{DefaultHasher, Hasher};
use std::ops::Range;
use std::path::Path;

/// Fewest sites of a population: fewer do not hold the middle of its input, a Gaussian of some sites' width. Chosen by
/// hand; the shipped networks have 10.
const LEAST_SITES: usize = 6;

impl NetworkPlan {
    /// Makes the network of the task file at `path` by the rules of the network file that it names.
    ///
    /// # Errors
    /// A [`TaskError`] that names file, line, key and what was expected.
    pub fn load(path: &Path) -> Result<(Task, Self), TaskError> {
        let (task, network, learned) = crate::load_task::load(path)?;
        let made = Self::of_task(task, &network).map_err(|error| error.with_task(path));
        let (mut task, mut plan) = made?;
        if let Some(learned) = learned {
            plan.learn(&mut task, &learned)?;
        }
        Ok((task, plan))
    }

    /// Makes the network of a task made in code, by the rules of the network file at `rules`; the rules' fingerprint is
    /// added to the task's.
    ///
    /// # Errors
    /// A [`TaskError`] that names the network file's line, key and what was expected.
    ///
    /// # Panics
    /// An index in the task is out of the range of the list that it belongs to. Those of a file are checked.
    pub fn of_task(mut task: Task, rules: &Path) -> Result<(Task, Self), TaskError> {
        let source = SourceFile::read(rules)?;
        let file: NetworkFile = source.parse()?;
        let mut hash = DefaultHasher::new();
        hash.write(source.text().as_bytes());
        let plan = Wiring { source: &source, file: &file, task: &task }.plan()?;
        task.fingerprint ^= hash.finish();
        Ok((task, plan))
    }
}

struct Wiring<'a> {
    source: &'a SourceFile,
    file: &'a NetworkFile,
    task: &'a Task,
}

impl Wiring<'_> {
    fn plan(&self) -> Result<NetworkPlan, TaskError> {
        let (layers, populations) = self.layers()?;
        let (channels, channel_names) = channels(self.task, populations.len());
        let named = |layer: &LayerPlan| (layer.kind.name().to_owned(), layer.populations.clone());
        let meanings = populations.iter().chain(channels.iter().map(|channel| &channel.meaning));
        let rules = SynapseRules {
            source: self.source,
            task: self.task,
            names: layers.iter().map(named).chain(channel_names).collect(),
            meanings: meanings.cloned().collect(),
        };
        let mut synapses = rules.connect("synapse", &self.file.synapse)?;
        synapses.sort_by_key(|synapse| (synapse.to, synapse.rule, synapse.from));
        Ok(NetworkPlan {
            forgetting: rules.connect("forgetting", &self.file.forgetting)?,
            reasons: self.file.synapse.iter().map(|rule| rule.why.clone()).collect(),
            pools: self.file.synapse.iter().map(|rule| rule.pool).collect(),
            widths: self.task.kinds.iter().map(|kind| kind.width).collect(),
            undue: self.undue()?,
            destinations: destination_field(self.source, &self.file.destinations, &self.task.scene)?,
            grips: grip_field(self.source, &self.file.grips, self.task)?,
            sites_per_population: *self.file.sites.per_population.get_ref(),
            layers,
            populations,
            channels,
            synapses,
        })
    }

    fn undue(&self) -> Result<f64, TaskError> {
        let (undue, span) = (*self.file.undue.get_ref(), self.file.undue.span());
        let problem = "expected a number above 0, at most 1";
        (undue > 0.0 && undue <= 1.0)
            .then_some(undue)
            .ok_or_else(|| self.source.error(span, "undue", problem))
    }

    fn layers(&self) -> Result<(Vec<LayerPlan>, Vec<Population>), TaskError> {
        let mut layers = Vec::new();
        let mut row = Vec::new();
        for kind in LayerKind::ALL {
            let name = kind.name();
            let position = self.file.layer.iter().position(|entry| entry.name.get_ref() == name);
            let index = position.ok_or_else(|| {
                self.source.error(0..0, "layer", format!("no layer is named {name:?}; expected all nine"))
            })?;
            let own = populations(self.task, kind);
            let range = row.len()..row.len() + own.len();
            layers.push(self.layer(index, kind, range)?);
            row.extend(own);
        }
        self.check_names()?;
        self.check_size(row.len())?;
        Ok((layers, row))
    }

    /// Refuses layers that the architecture does not have.
    fn check_names(&self) -> Result<(), TaskError> {
        let is_known = |name: &str| LayerKind::ALL.iter().any(|kind| kind.name() == name);
        let unknown = self.file.layer.iter().enumerate().find(|(_, entry)| !is_known(entry.name.get_ref()));
        let Some((index, entry)) = unknown else { return Ok(()) };
        let names = LayerKind::ALL.map(|kind| format!("{:?}", kind.name())).join(", ");
        let problem = format!("{:?} is no layer; expected one of {names}", entry.name.get_ref());
        Err(self.source.error(entry.name.span(), format!("layer[{index}].name"), problem))
    }

    /// Refuses a network that a field frame has no room for.
    fn check_size(&self, populations: usize) -> Result<(), TaskError> {
        let width = &self.file.sites.per_population;
        let per_population = *width.get_ref();
        let fits = populations <= MAX_POPULATIONS && populations.saturating_mul(per_population) <= MAX_SITES;
        if per_population >= LEAST_SITES && fits {
            return Ok(());
        }
        let problem = format!(
            "{populations} populations of {per_population} sites; expected at least {LEAST_SITES} sites each, at most \
             {MAX_POPULATIONS} populations and {MAX_SITES} sites in all"
        );
        Err(self.source.error(width.span(), "sites.per_population", problem))
    }

    fn layer(
        &self,
        index: usize,
        kind: LayerKind,
        populations: Range<usize>,
    ) -> Result<LayerPlan, TaskError> {
        let entry = &self.file.layer[index];
        let resting = *entry.h.get_ref();
        Ok(LayerPlan {
            kind,
            parameters: self.parameters(index)?,
            resting,
            gain: entry.gain,
            noise: entry.noise,
            forgetting: entry.forgets.as_ref().map(|forgets| Forgetting {
                h_max: resting,
                h_min: forgets.h_min,
                r_min: forgets.r_min,
                r_max: forgets.r_max,
            }),
            populations,
        })
    }

    /// The constants of a layer's field, checked.
    fn parameters(&self, index: usize) -> Result<Parameters, TaskError> {
        let LayerEntry { name, tau, h, slope, threshold, kernel, .. } = &self.file.layer[index];
        let KernelEntry { amplitude, sigma, inhibition, range } = *kernel;
        let parameters = Parameters {
            tau: *tau,
            slope: *slope,
            threshold: *threshold,
            spacing: self.file.sites.spacing,
            input_sigma: self.file.sites.input_sigma,
            kernel: Kernel { amplitude, sigma, inhibition, range },
        };
        let key = |key: &str| format!("layer[{index}].{key} ({})", name.get_ref());
        parameters
            .check()
            .map_err(|error| self.source.error(name.span(), key(error.name), error.to_string()))?;
        if *tau < LEAST_TAU {
            let problem = format!(
                "tau is {tau}; expected at least {LEAST_TAU} ms: Euler steps of 1 ms need dt/tau <= 0.05"
            );
            return Err(self.source.error(name.span(), key("tau"), problem));
        }
        if *h.get_ref() >= 0.0 {
            return Err(self.source.error(h.span(), key("h"), "expected a resting level below 0"));
        }
        Ok(parameters)
    }
}
