//! What needs several sources never ignites from one: every population of ASL, IL and AEL, for every shipped task.
#![allow(clippy::unwrap_used)]

use coact_joint_task::{Channel, NetworkPlan, Pool, Synapse};
use coact_messages::LayerKind::{self, ActionExecution, ActionSimulation, ErrorMonitoring, Intention};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Strength that ignites a population at rest, less a margin for noise.
const IGNITES: f64 = 0.97;

fn shipped_tasks() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    files.filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect()
}

/// A source in the sense of the chapter: another layer, or one channel of the percept. What is observed of the hand is
/// one, by the role of the act, because acts of different roles exclude each other, and which part it is bound for is told
/// with its grasp; what the person says is another.
fn source(plan: &NetworkPlan, from: usize) -> String {
    match plan.layer_of(from) {
        None if matches!(plan.channels[from - plan.populations.len()].channel, Channel::BoundFor(_)) => {
            GRASP.into()
        }
        None => plan.meaning(from).label.split(':').next().unwrap_or_default().to_owned(),
        Some(layer) if layer.kind == LayerKind::ActionObservation => {
            format!("{} {}", layer.kind.name(), plan.meaning(from).role)
        }
        Some(layer) => layer.kind.name().to_owned(),
    }
}

/// A hand that grasps reaches as well.
const REACH: &str = "AOL reach";
const GRASP: &str = "AOL grasp";
/// What is there whatever happens: no source is without it.
const ALWAYS: &str = "always";

/// The most that each source can contribute to population `to` by itself, with what is always there.
fn strongest(plan: &NetworkPlan, to: usize) -> BTreeMap<String, f64> {
    let synapses: Vec<Synapse> = plan.synapses.iter().copied().filter(|synapse| synapse.to == to).collect();
    let mut most = BTreeMap::new();
    for group in synapses.chunk_by(|a, b| a.rule == b.rule) {
        for synapse in group.iter().filter(|synapse| synapse.weight > 0.0) {
            let total = most.entry(source(plan, synapse.from)).or_insert(0.0_f64);
            match plan.pools[synapse.rule] {
                Pool::Sum => *total += synapse.weight,
                Pool::Any | Pool::Every if synapse.from == group[0].from => *total += synapse.weight,
                Pool::Any | Pool::Every => {}
                Pool::Absent => *total += synapse.weight,
            }
        }
    }
    let always = synapses.iter().filter(|synapse| source(plan, synapse.from) == ALWAYS);
    let always: f64 = always.map(|synapse| synapse.weight).sum();
    most.iter_mut().filter(|(source, _)| *source != ALWAYS).for_each(|(_, most)| *most += always);
    if let (Some(reach), Some(grasp)) = (most.get(REACH).copied(), most.get_mut(GRASP)) {
        *grasp += reach;
    }
    most
}

/// Layers in which one peak stands: as a source they count with their strongest synapse, not with the sum of them all.
fn decides(source: &str) -> bool {
    [ActionSimulation, Intention, ErrorMonitoring, ActionExecution].iter().any(|layer| layer.name() == source)
}

/// What may ignite a layer alone: a decision that has been taken before, from several sources.
fn suffices(layer: LayerKind, source: &str) -> bool {
    match layer {
        Intention => source == ActionSimulation.name(),
        ActionExecution => source == Intention.name() || source == ErrorMonitoring.name(),
        _ => false,
    }
}

#[test]
fn no_population_that_needs_several_sources_ignites_from_one() {
    let tasks = shipped_tasks();
    assert!(tasks.len() >= 3);
    for path in tasks {
        let (task, plan) = NetworkPlan::load(&path).unwrap();
        for layer in [ActionSimulation, Intention, ActionExecution] {
            for to in plan.layer(layer).populations.clone() {
                for (source, most) in strongest(&plan, to) {
                    let alone = suffices(layer, &source) || decides(&source);
                    let label = &plan.populations[to].label;
                    assert!(
                        alone || most < IGNITES,
                        "{}: {} \"{label}\" gets {most:.2} from {source} alone",
                        task.name,
                        layer.name()
                    );
                }
            }
        }
    }
}

#[test]
fn every_population_of_the_simulation_can_ignite_from_all_its_sources() {
    // The other half of the gate: what is never reached would pass the test above.
    for path in shipped_tasks() {
        let (task, plan) = NetworkPlan::load(&path).unwrap();
        for to in plan.layer(ActionSimulation).populations.clone() {
            let most: f64 = strongest(&plan, to).values().sum();
            let label = &plan.populations[to].label;
            assert!(most > 1.05, "{}: \"{label}\" gets {most:.2} at most", task.name);
        }
    }
}
