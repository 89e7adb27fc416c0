use crate::due_kinds::Beforehand;
use crate::likely::Likely;
use crate::{destination_field, grip_field};
use coact_joint_task::{Channel, NetworkPlan};
use coact_messages::{FieldFrame, MAX_KINDS, Percept};
use coact_period::cycles;
use std::time::Duration;

/// Age up to which a percept tells what is now; beyond it, memories stay and everything else loses its input. Chosen by
/// hand: it bridges gaps of some frames, and is short beside a reach of 350 to 900 ms.
const PERCEPT_LIFETIME: u64 = cycles(Duration::from_millis(200));

/// Whether a percept still tells what is now.
pub(crate) fn is_fresh(tick: u64, percept: &Percept) -> bool {
    tick.saturating_sub(percept.header.cycle) <= PERCEPT_LIFETIME
}

/// Writes what all synapses start from: the signals of all populations, then the values of the channels, by what is perceived now and by
/// where the peaks of the fields that select stand.
pub(crate) fn collect(
    network: &NetworkPlan,
    percept: Option<&Percept>,
    previous: &FieldFrame,
    beforehand: &Beforehand,
    sources: &mut [f64],
) {
    let populations = network.populations.len();
    sources[..populations].copy_from_slice(&previous.signal[..populations]);
    let taken = percept.map(|percept| {
        let likely = Likely { destinations: &percept.destinations, beforehand };
        destination_field::signals(&network.destinations, &previous.destination, likely)
    });
    for (source, plan) in sources[populations..].iter_mut().zip(&network.channels) {
        let value = match (percept, taken) {
            (Some(percept), Some(taken)) => {
                let grip = |grip: usize, kind: usize| {
                    let width = network.widths[kind];
                    grip_field::signal_of(&network.grips, &previous.grip, &percept.grips, grip, width)
                };
                read(percept, &taken, grip, plan.channel)
            }
            _ => f64::from(plan.channel == Channel::Always),
        };
        // A broken sensor may deliver anything; evidence is a number between 0 and 1.
        *source = if value.is_finite() { value.clamp(0.0, 1.0) } else { 0.0 };
    }
}

/// `grip` tells the signal of a grip with which a part of some kind is taken, or held.
fn read(
    percept: &Percept,
    taken: &[f64; MAX_KINDS],
    grip: impl Fn(usize, usize) -> f64,
    channel: Channel,
) -> f64 {
    match channel {
        Channel::Always => 1.0,
        Channel::Act(act) => percept.act[act],
        Channel::Hold { act, grip: own, kind } => percept.act[act] * grip(own, kind),
        Channel::Destination { grip: own, kind } => taken[kind] * grip(own, kind),
        Channel::BoundFor(kind) => taken[kind],
        Channel::Seen { workspace, kind } => percept.workspace[workspace].seen[kind],
        Channel::Gone { workspace, kind } => percept.workspace[workspace].gone[kind],
        Channel::Achieved(subgoal) => percept.achieved[subgoal],
        Channel::Open(subgoal) => percept.open[subgoal],
        Channel::RobotHolds(kind) => percept.robot_holds[kind],
        Channel::PersonHolds(kind) => percept.person_holds[kind],
        Channel::Lost(kind) => percept.lost[kind],
    }
}
