use coact_joint_task::{Channel, NetworkPlan, Pool, Role, Synapse};
use coact_messages::LayerKind;
use serde::Serialize;

/// How the robot's network differs from the one that the task's files make: without anticipation, or with ablations.
///
/// The reactive robot is the baseline. It answers what the person *has* done, and is otherwise the same:
/// - A grip counts once the part is in the person's hand. Evidence of a grip reaches AOL through a gate that opens when
///   the part is seen in the hand; the shape and the path of a hand that still reaches do not pass it.
/// - A gesture counts once the hand has stopped.
/// - Nothing is inferred from a hand that is hidden.
/// - An inferred goal does not count as achieved before it is: synapses from IL to CSGL are removed.
///
/// What the person says, what lies where and the robot's own initiative are no predictions, and stay. The myopic robot does not look ahead in its own
/// work either: its hand gets ready for nothing that is not decided, and what it is about to mount opens no next step before it is done.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct NetworkVariant {
    /// Without anticipation.
    pub reactive: bool,
    /// Without look-ahead.
    pub myopic: bool,
    /// Layers, or the noise, that are removed.
    pub without: Vec<Ablation>,
}

/// What can be removed from the network.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Ablation {
    /// Object memory: what lies where.
    Oml,
    /// Common subgoals, both sublayers: the plan, and what is achieved.
    Csgl,
    /// Error monitoring.
    Eml,
    /// The noise in the decision layers.
    Noise,
}

impl NetworkVariant {
    /// The network of this variant, made from the whole one.
    pub fn apply(&self, mut plan: NetworkPlan) -> NetworkPlan {
        if self.reactive {
            remove_anticipation(&mut plan);
        }
        if self.myopic {
            remove_look_ahead(&mut plan);
        }
        for ablation in &self.without {
            match ablation {
                Ablation::Oml => {
                    silence(&mut plan, &[LayerKind::ObjectMemoryRobot, LayerKind::ObjectMemoryPerson]);
                }
                Ablation::Csgl => {
                    silence(&mut plan, &[LayerKind::SubgoalsAchieved, LayerKind::SubgoalsAvailable]);
                }
                Ablation::Eml => silence(&mut plan, &[LayerKind::ErrorMonitoring]),
                Ablation::Noise => plan.layers.iter_mut().for_each(|layer| layer.noise = 0.0),
            }
        }
        plan.synapses.sort_by_key(|synapse| (synapse.to, synapse.rule, synapse.from));
        plan
    }
}

/// Removes every synapse of the layers: they stay at rest, and nothing depends on them.
fn silence(plan: &mut NetworkPlan, kinds: &[LayerKind]) {
    let rows: Vec<_> = kinds.iter().map(|kind| plan.layer(*kind).populations.clone()).collect();
    let apart =
        |synapse: &Synapse| !rows.iter().any(|row| row.contains(&synapse.from) || row.contains(&synapse.to));
    plan.synapses.retain(apart);
}

/// Removes what the robot's own next step, and the part in its hand, open before it is done.
fn remove_look_ahead(plan: &mut NetworkPlan) {
    let row = |kind: LayerKind| plan.layer(kind).populations.clone();
    let (decided, next) = (row(LayerKind::ActionExecution), row(LayerKind::SubgoalsAvailable));
    let synapses = plan.synapses.iter().copied();
    let kept = synapses.filter(|synapse| {
        let held = matches!(channel_of(plan, synapse.from), Some(Channel::RobotHolds(_)));
        !(next.contains(&synapse.to) && (held || decided.contains(&synapse.from)))
    });
    plan.synapses = kept.collect();
}

/// Removes what anticipates: synapses that predict, and evidence of acts that are not completed.
fn remove_anticipation(plan: &mut NetworkPlan) {
    let rows = |kind: LayerKind| plan.layer(kind).populations.clone();
    let (acts, goals) = (rows(LayerKind::ActionObservation), rows(LayerKind::Intention));
    let subgoals = [rows(LayerKind::SubgoalsAchieved), rows(LayerKind::SubgoalsAvailable)];
    let hidden =
        |synapse: &Synapse| acts.contains(&synapse.to) && plan.populations[synapse.to].role == Role::Hidden;
    let predicted = |synapse: &Synapse| {
        goals.contains(&synapse.from) && subgoals.iter().any(|row| row.contains(&synapse.to))
    };
    let foreseen = |synapse: &Synapse| {
        let channel = channel_of(plan, synapse.from);
        matches!(channel, Some(Channel::Destination { .. } | Channel::BoundFor(_)))
    };
    let anticipates = |synapse: &Synapse| hidden(synapse) || predicted(synapse) || foreseen(synapse);
    let others = plan.synapses.iter().filter(|synapse| !anticipates(synapse));
    let mut synapses: Vec<Synapse> = others.copied().collect();
    let rule = plan.reasons.len();
    let mut gate = |from: Option<usize>, to: usize, weight: f64| {
        synapses.extend(from.map(|from| Synapse { from, to, weight, rule }));
    };
    for act in acts {
        let strength = evidence(plan, act);
        let meaning = &plan.populations[act];
        if meaning.role == Role::Gesture {
            let reach = channel(plan, |own, role| matches!(own, Channel::Act(_)) && role == Role::Reach);
            gate(reach, act, -strength);
        }
    }
    plan.synapses = synapses;
    plan.reasons.push("without anticipation, the robot waits until the person has acted".into());
    plan.pools.push(Pool::Sum);
}

/// Weight with which perception's evidence drives an act.
fn evidence(plan: &NetworkPlan, act: usize) -> f64 {
    let from_acts = |synapse: &&Synapse| {
        synapse.to == act
            && matches!(channel_of(plan, synapse.from), Some(Channel::Act(_) | Channel::Hold { .. }))
    };
    plan.synapses.iter().filter(from_acts).map(|synapse| synapse.weight).sum()
}

/// The channel that a synapse comes from, if it is one.
fn channel_of(plan: &NetworkPlan, from: usize) -> Option<Channel> {
    Some(plan.channels[from.checked_sub(plan.populations.len())?].channel)
}

/// Index of a channel, which follow the populations.
fn channel(plan: &NetworkPlan, is_it: impl Fn(Channel, Role) -> bool) -> Option<usize> {
    let index = plan.channels.iter().position(|own| is_it(own.channel, own.meaning.role))?;
    Some(plan.populations.len() + index)
}
