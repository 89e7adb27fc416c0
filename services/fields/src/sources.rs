use coact_joint_task::{Channel, NetworkPlan};
use coact_messages::Percept;
use coact_period::cycles;
use std::time::Duration;

/// Age up to which a percept tells what is now; beyond it, memories stay and everything else loses its input. Chosen by
/// hand: it bridges gaps of some frames, and is short beside a reach of 350 to 900 ms.
const PERCEPT_LIFETIME: u64 = cycles(Duration::from_millis(200));

/// Writes what all synapses start from: the signals of all populations, then the values of the percept's channels.
pub(crate) fn collect(
    plan: &NetworkPlan,
    tick: u64,
    percept: Option<&Percept>,
    signal: &[f64],
    sources: &mut [f64],
) {
    let populations = plan.populations.len();
    sources[..populations].copy_from_slice(&signal[..populations]);
    let fresh = percept.filter(|percept| tick.saturating_sub(percept.header.cycle) <= PERCEPT_LIFETIME);
    for (source, plan) in sources[populations..].iter_mut().zip(&plan.channels) {
        let value =
            fresh.map_or(f64::from(plan.channel == Channel::Always), |percept| read(percept, plan.channel));
        // A broken sensor may deliver anything; evidence is a number between 0 and 1.
        *source = if value.is_finite() { value.clamp(0.0, 1.0) } else { 0.0 };
    }
}

fn read(percept: &Percept, channel: Channel) -> f64 {
    match channel {
        Channel::Always => 1.0,
        Channel::Act(act) => percept.act[act],
        Channel::Seen { workspace, kind } => percept.workspace[workspace].seen[kind],
        Channel::Gone { workspace, kind } => percept.workspace[workspace].gone[kind],
        Channel::Achieved(subgoal) => percept.achieved[subgoal],
        Channel::Open(subgoal) => percept.open[subgoal],
        Channel::RobotHolds(kind) => percept.robot_holds[kind],
        Channel::PersonHolds(kind) => percept.person_holds[kind],
        Channel::Lost(kind) => percept.lost[kind],
    }
}
