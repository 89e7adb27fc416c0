//! From the network file's rules and a task to layers, populations and synapses.

use crate::error::Source;
use crate::network_file::{Attribute, LayerEntry, NetworkFile, Relation, RuleEntry, Selector};
use crate::network_plan::{Channel, ChannelPlan, LayerPlan, NetworkPlan, Synapse};
use crate::population::{Population, acts, objects, populations, subgoals};
use crate::{Agent, Task, TaskError};
use coact_messages::{LayerKind, MAX_POPULATIONS, MAX_SITES};
use coact_neural_field::{Forgetting, Kernel, Parameters};
use std::hash::{DefaultHasher, Hasher};
use std::ops::Range;
use std::path::Path;

impl NetworkPlan {
    /// Makes the network of the task file at `path` by the rules of the network file that it names.
    ///
    /// # Errors
    /// A [`TaskError`] that names file, line, key and what was expected.
    pub fn load(path: &Path) -> Result<(Task, Self), TaskError> {
        let (mut task, network, learned) = crate::load::load(path)?;
        let (mut plan, fingerprint) = wire(&task, &network)?;
        task.fingerprint ^= fingerprint;
        if let Some(learned) = learned {
            plan.learn(&mut task, &learned)?;
        }
        Ok((task, plan))
    }
}

/// The network of `task` by the rules at `path`, and the fingerprint of those rules.
fn wire(task: &Task, path: &Path) -> Result<(NetworkPlan, u64), TaskError> {
    let source = Source::read(path)?;
    let file: NetworkFile = source.parse()?;
    let mut hash = DefaultHasher::new();
    hash.write(source.text().as_bytes());
    let plan = Wiring { source: &source, file: &file, task }.plan()?;
    Ok((plan, hash.finish()))
}

struct Wiring<'a> {
    source: &'a Source,
    file: &'a NetworkFile,
    task: &'a Task,
}

/// A place in the row of populations and channels under a name of the network file.
struct Row {
    names: Vec<(String, Range<usize>)>,
    meanings: Vec<Population>,
}

impl Wiring<'_> {
    fn plan(&self) -> Result<NetworkPlan, TaskError> {
        let (layers, populations) = self.layers()?;
        let (channels, channel_names) = channels(self.task, populations.len());
        let row = Row {
            names: layers
                .iter()
                .map(|layer| (layer.kind.name().into(), layer.populations.clone()))
                .chain(channel_names)
                .collect(),
            meanings: populations
                .iter()
                .chain(channels.iter().map(|channel| &channel.meaning))
                .cloned()
                .collect(),
        };
        let mut synapses = self.connect("synapse", &self.file.synapse, &row)?;
        synapses.sort_by_key(|synapse| (synapse.to, synapse.rule, synapse.from));
        Ok(NetworkPlan {
            forgetting: self.connect("forgetting", &self.file.forgetting, &row)?,
            reasons: self.file.synapse.iter().map(|rule| rule.why.clone()).collect(),
            pools: self.file.synapse.iter().map(|rule| rule.pool).collect(),
            sites_per_population: *self.file.sites.per_population.get_ref(),
            layers,
            populations,
            channels,
            synapses,
        })
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
        for (index, entry) in self.file.layer.iter().enumerate() {
            if !LayerKind::ALL.iter().any(|kind| kind.name() == entry.name.get_ref()) {
                let names = LayerKind::ALL.map(|kind| format!("{:?}", kind.name())).join(", ");
                let problem = format!("{:?} is no layer; expected one of {names}", entry.name.get_ref());
                return Err(self.source.error(entry.name.span(), format!("layer[{index}].name"), problem));
            }
        }
        let width = &self.file.sites.per_population;
        let sites = row.len() * width.get_ref();
        if *width.get_ref() < 6 || row.len() > MAX_POPULATIONS || sites > MAX_SITES {
            let problem = format!(
                "{} populations of {} sites; expected at least 6 sites each, at most {MAX_POPULATIONS} populations \
                 and {MAX_SITES} sites in all",
                row.len(),
                width.get_ref()
            );
            return Err(self.source.error(width.span(), "sites.per_population", problem));
        }
        Ok((layers, row))
    }

    fn layer(
        &self,
        index: usize,
        kind: LayerKind,
        populations: Range<usize>,
    ) -> Result<LayerPlan, TaskError> {
        let LayerEntry { name, tau, h, slope, threshold, gain, noise, kernel, forgets } =
            &self.file.layer[index];
        let parameters = Parameters {
            tau: *tau,
            slope: *slope,
            threshold: *threshold,
            spacing: self.file.sites.spacing,
            input_sigma: self.file.sites.input_sigma,
            kernel: Kernel {
                amplitude: kernel.amplitude,
                sigma: kernel.sigma,
                inhibition: kernel.inhibition,
                range: kernel.range,
            },
        };
        let key = |key: &str| format!("layer[{index}].{key} ({})", name.get_ref());
        parameters
            .check()
            .map_err(|error| self.source.error(name.span(), key(error.name), error.to_string()))?;
        if *tau < 20.0 {
            let problem =
                format!("tau is {tau}; expected at least 20 ms: Euler steps of 1 ms need dt/tau <= 0.05");
            return Err(self.source.error(name.span(), key("tau"), problem));
        }
        if *h.get_ref() >= 0.0 {
            return Err(self.source.error(h.span(), key("h"), "expected a resting level below 0"));
        }
        let forgetting = forgets.as_ref().map(|forgets| Forgetting {
            h_max: *h.get_ref(),
            h_min: forgets.h_min,
            r_min: forgets.r_min,
            r_max: forgets.r_max,
        });
        Ok(LayerPlan {
            kind,
            parameters,
            resting: *h.get_ref(),
            gain: *gain,
            noise: *noise,
            forgetting,
            populations,
        })
    }

    fn connect(&self, table: &str, rules: &[RuleEntry], row: &Row) -> Result<Vec<Synapse>, TaskError> {
        let mut synapses = Vec::new();
        for (index, rule) in rules.iter().enumerate() {
            let sources = self.select(&format!("{table}[{index}].from"), &rule.from, row, true)?;
            let targets = self.select(&format!("{table}[{index}].to"), &rule.to, row, false)?;
            for &to in &targets {
                let related = |&&from: &&usize| self.related(rule, &row.meanings[from], &row.meanings[to]);
                let found: Vec<usize> = sources.iter().filter(related).copied().collect();
                let divisor =
                    if rule.normalised { self.divisor(rule, found.len(), &row.meanings[to]) } else { 1.0 };
                let weight = rule.weight / divisor;
                synapses.extend(found.into_iter().map(|from| Synapse { from, to, weight, rule: index }));
            }
        }
        Ok(synapses)
    }

    /// The divisor of a normalised weight: the number of sources or, where the plan relates them, the number of all
    /// steps that come before, because a source that stands for one of them tells nothing of the others.
    fn divisor(&self, rule: &RuleEntry, sources: usize, to: &Population) -> f64 {
        let steps = match (rule.relation, to.subgoal) {
            (Some(Relation::Before), Some(subgoal)) => self.task.subgoals[subgoal].after.len(),
            _ => sources,
        };
        steps.max(1) as f64
    }

    fn select(
        &self,
        key: &str,
        selector: &Selector,
        row: &Row,
        source: bool,
    ) -> Result<Vec<usize>, TaskError> {
        let Selector { layer, role, side, workspace, steadied, first } = selector;
        let names = || row.names.iter().filter(|(_, range)| source || range.start < self.layer_end(row));
        let range = names().find(|(name, _)| name == layer.get_ref()).map(|(_, range)| range.clone());
        let range = range.ok_or_else(|| {
            let known: Vec<_> = names().map(|(name, _)| format!("{name:?}")).collect();
            let problem = format!("{:?} is unknown; expected one of {}", layer.get_ref(), known.join(", "));
            self.source.error(layer.span(), format!("{key}.layer"), problem)
        })?;
        if let Some(role) = role {
            self.known_role(key, role)?;
        }
        Ok(range
            .filter(|&index| {
                let meaning = &row.meanings[index];
                role.as_ref().is_none_or(|role| meaning.role == role.get_ref())
                    && side.is_none_or(|side| meaning.side == Some(side))
                    && workspace.is_none_or(|workspace| meaning.workspace == Some(workspace))
                    && steadied.is_none_or(|steadied| meaning.steadied == steadied)
                    && first.is_none_or(|first| meaning.first == first)
            })
            .collect())
    }

    fn layer_end(&self, row: &Row) -> usize {
        row.names[LayerKind::ALL.len() - 1].1.end
    }

    fn known_role(&self, key: &str, role: &crate::file::Name) -> Result<(), TaskError> {
        const ROLES: [&str; 21] = [
            "rest", "idle", "reach", "hidden", "word", "gesture", "grasp", "grip", "insert", "request",
            "receive", "give", "steady", "point", "speak", "report", "subgoal", "goal", "done", "means",
            "loss",
        ];
        if ROLES.contains(&role.get_ref().as_str()) {
            return Ok(());
        }
        let problem = format!("{:?} is no role; expected one of {}", role.get_ref(), ROLES.join(", "));
        Err(self.source.error(role.span(), format!("{key}.role"), problem))
    }

    fn related(&self, rule: &RuleEntry, from: &Population, to: &Population) -> bool {
        let same = rule.same.iter().all(|&attribute| alike(attribute, from, to));
        let unlike =
            rule.unlike.is_empty() || rule.unlike.iter().any(|&attribute| !alike(attribute, from, to));
        same && unlike
            && match rule.relation {
                None => true,
                Some(Relation::Before) => self.comes_before(from, to),
                Some(Relation::Answers) => {
                    from.answer.is_some()
                        && from.answer == to.rule
                        && (to.subgoal.is_none() || from.subgoal == to.subgoal)
                        && (to.role != "steady" || from.steadied)
                }
            }
    }
}

impl Wiring<'_> {
    /// Whether the plan puts the subgoal of `from` directly before that of `to`; of a population that stands for a kind
    /// of part, before one of the subgoals that need it.
    fn comes_before(&self, from: &Population, to: &Population) -> bool {
        let Some(before) = from.subgoal else { return false };
        let follows = |after: &usize| self.task.subgoals[*after].after.contains(&before);
        match to.subgoal {
            Some(after) => follows(&after),
            None => (0..self.task.subgoals.len())
                .filter(|&goal| Some(self.task.subgoals[goal].kind) == to.kind)
                .any(|goal| follows(&goal)),
        }
    }
}

/// Whether both stand for the same thing, and both for one at all.
fn alike(attribute: Attribute, from: &Population, to: &Population) -> bool {
    fn equal<T: PartialEq>(from: &Option<T>, to: &Option<T>) -> bool {
        from.is_some() && from == to
    }
    match attribute {
        Attribute::Act => equal(&from.act, &to.act),
        Attribute::Kind => equal(&from.kind, &to.kind),
        Attribute::Grip => equal(&from.grip, &to.grip),
        Attribute::Gesture => equal(&from.gesture, &to.gesture),
        Attribute::Subgoal => equal(&from.subgoal, &to.subgoal),
        Attribute::Side => equal(&from.side, &to.side),
        Attribute::Workspace => equal(&from.workspace, &to.workspace),
        Attribute::Chain => equal(&from.chain, &to.chain),
    }
}

/// All channels of the percept, and their names with their places behind `first`.
fn channels(task: &Task, first: usize) -> (Vec<ChannelPlan>, Vec<(String, Range<usize>)>) {
    let mut channels = Vec::new();
    let mut names = Vec::new();
    let mut add = |name: &str, meanings: Vec<Population>, channel: &dyn Fn(usize) -> Channel| {
        let start = first + channels.len();
        let plan = |(index, meaning): (usize, Population)| ChannelPlan {
            channel: channel(index),
            meaning: Population { label: format!("{name}: {}", meaning.label), ..meaning },
        };
        channels.extend(meanings.into_iter().enumerate().map(plan));
        names.push((name.to_string(), start..first + channels.len()));
    };
    add("always", vec![Population { role: "always", ..Population::default() }], &|_| Channel::Always);
    add("acts", acts(task), &Channel::Act);
    for (agent, name) in [(Agent::Robot, "robot"), (Agent::Person, "person")] {
        let workspace = agent.index();
        add(&format!("seen {name}"), objects(task, agent), &|kind| Channel::Seen { workspace, kind });
        add(&format!("gone {name}"), objects(task, agent), &|kind| Channel::Gone { workspace, kind });
    }
    add("achieved", subgoals(task), &Channel::Achieved);
    add("open", subgoals(task), &Channel::Open);
    add("robot holds", objects(task, Agent::Robot), &Channel::RobotHolds);
    add("person holds", objects(task, Agent::Person), &Channel::PersonHolds);
    add("lost", objects(task, Agent::Robot), &Channel::Lost);
    (channels, names)
}
