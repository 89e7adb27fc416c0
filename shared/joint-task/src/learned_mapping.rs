//! Learned connections from observed acts to simulated chains, from a file that `coact learn mapping` writes.

use crate::source_file::SourceFile;
use crate::task_file::Name;
use crate::{NetworkPlan, Pool, Population, Role, Synapse, Task, TaskError};
use coact_messages::LayerKind;
use serde::Deserialize;
use std::hash::{DefaultHasher, Hasher};
use std::ops::Range;
use std::path::Path;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LearnedFile {
    /// For people: how the weights came about.
    #[allow(dead_code, reason = "read by people")]
    provenance: toml::Table,
    connection: Vec<ConnectionEntry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ConnectionEntry {
    act: Name,
    chain: Name,
    weight: Spanned<f64>,
    /// For people: from how many successes; 0 = carried over from other kinds of part.
    #[allow(dead_code, reason = "read by people")]
    successes: u32,
}

impl NetworkPlan {
    /// Puts the learned connections of the file at `path` in the place of those that the network file gives: all that
    /// excite ASL from grasps and gestures in AOL. What inhibits, and every other connection, stays.
    ///
    /// # Errors
    /// A file that cannot be read, an act or chain that the task does not have, or a weight that is not in 0 to 1.
    pub fn learn(&mut self, task: &mut Task, path: &Path) -> Result<(), TaskError> {
        let source = SourceFile::read(path)?;
        let file: LearnedFile = source.parse()?;
        let rule = self.reasons.len();
        let mut learned = Vec::new();
        for (index, entry) in file.connection.iter().enumerate() {
            let weight = *entry.weight.get_ref();
            if !(0.0..=1.0).contains(&weight) {
                let key = format!("connection[{index}].weight");
                let problem = format!("{weight}; expected 0 to 1, in units of the ignition threshold");
                return Err(source.error(entry.weight.span(), key, problem));
            }
            let act = self.named(LayerKind::ActionObservation, &entry.act);
            let chain = self.named(LayerKind::ActionSimulation, &entry.chain);
            let unknown = |key: &str, name: &Name, what: &str| {
                let problem =
                    format!("{:?} is no {what} of this task; learn the mapping anew", name.get_ref());
                source.error(name.span(), format!("connection[{index}].{key}"), problem)
            };
            let from = act.ok_or_else(|| unknown("act", &entry.act, "act"))?;
            let to = chain.ok_or_else(|| unknown("chain", &entry.chain, "chain"))?;
            learned.push(Synapse { from, to, weight, rule });
        }
        let given: Vec<bool> = self.synapses.iter().map(|synapse| self.shows_a_chain(synapse)).collect();
        let mut given = given.into_iter();
        self.synapses.retain(|_| !given.next().unwrap_or(false));
        self.synapses.extend(learned);
        self.synapses.sort_by_key(|synapse| (synapse.to, synapse.rule, synapse.from));
        self.reasons.push("learned from actions that succeeded".into());
        self.pools.push(Pool::Sum);
        let mut hash = DefaultHasher::new();
        hash.write(source.text().as_bytes());
        task.fingerprint ^= hash.finish().rotate_left(1);
        Ok(())
    }

    /// Whether the connection excites a chain from a grasp or a gesture: what [`NetworkPlan::learn`] replaces.
    pub fn shows_a_chain(&self, synapse: &Synapse) -> bool {
        let acts = &self.layer(LayerKind::ActionObservation).populations;
        let chains = &self.layer(LayerKind::ActionSimulation).populations;
        let tells = |population: &Population| [Role::Grasp, Role::Gesture].contains(&population.role);
        synapse.weight > 0.0
            && acts.contains(&synapse.from)
            && chains.contains(&synapse.to)
            && tells(&self.populations[synapse.from])
    }

    fn named(&self, layer: LayerKind, name: &Name) -> Option<usize> {
        let mut populations: Range<usize> = self.layer(layer).populations.clone();
        populations.find(|&index| self.populations[index].label == *name.get_ref())
    }
}
