//! A partner who loses no time: does what the plan allows at once, gives before being asked, and gets the next part ready while the robot
//! mounts what comes before it.

use crate::{Intention, Surroundings, Undertaking, Variation, synthetic_policy};
use coact_joint_task::{Act, Agent};
use rand::{Rng, RngExt};

/// What the person does next: receives what the robot gives, does one of the valid activities, or prepares one whose turn is coming.
pub(crate) fn choose<R: Rng>(around: &Surroundings, rng: &mut R) -> Undertaking {
    let valid = around.receive().or_else(|| synthetic_policy::draw(around, rng, |_| true));
    let next = valid.or_else(|| preparation(around));
    next.map_or_else(|| Undertaking::Await(rng.random_range(synthetic_policy::RETHINK)), Undertaking::Begin)
}

/// To take an own part for a step whose turn is coming.
fn preparation(around: &Surroundings) -> Option<Intention> {
    let chains = around.task.chains.iter().enumerate();
    let mut own =
        chains.filter(|(_, chain)| chain.from == Agent::Person && matches!(chain.act, Act::Grasp { .. }));
    own.find_map(|(index, chain)| {
        let goals = around.task.subgoals.iter().enumerate();
        let mut served = goals.filter(|(_, goal)| goal.kind == chain.kind && goal.side == chain.side);
        let (subgoal, _) = served.find(|(goal, _)| around.is_coming(*goal))?;
        let part = around.own_part(chain.kind)?;
        let activity = around.activity(index);
        let (subgoal, part, variation) = (Some(subgoal), Some(part), Variation::default());
        Some(Intention { activity, chain: index, subgoal, part, variation })
    })
}
