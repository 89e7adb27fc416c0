//! A partner who loses no time: does what the plan allows at once, gives before being asked, and gets the next part ready while the robot
//! mounts what comes before it.

use crate::{Intention, Surroundings, Undertaking, synthetic_policy};
use rand::{Rng, RngExt};

/// What the person does next: receives what the robot gives, does one of the valid activities, or prepares one whose turn is coming.
pub(crate) fn choose<R: Rng>(around: &Surroundings, rng: &mut R) -> Undertaking {
    let valid = around.receive().or_else(|| synthetic_policy::draw(around, rng, |_| true));
    let next = valid.or_else(|| preparation(around));
    next.map_or_else(|| Undertaking::Await(rng.random_range(synthetic_policy::RETHINK)), Undertaking::Begin)
}

/// To take an own part for a step whose turn is coming.
fn preparation(around: &Surroundings) -> Option<Intention> {
    let task = around.task;
    task.chains.iter().enumerate().find_map(|(index, chain)| {
        let mut goals = task.subgoals.iter().enumerate();
        let served = (chain.kind, chain.side);
        let (goal, _) =
            goals.find(|(goal, step)| (step.kind, step.side) == served && around.is_coming(*goal))?;
        around.taking(index, Some(goal))
    })
}
