//! What the person's hand exerts on the robot's, through a part that both have.

use crate::{ActivityPhase, Person, PersonState, Surroundings};
use coact_period::PERIOD_S;
use glam::DVec3;

/// Growth of the force, N/s, and how far the person pulls at a part that the robot does not let go, N. In the recorded
/// handover of Khanna et al. (RO-MAN 2023) the force between the two people turns round with 11 N/s as the part changes
/// hands, and stays at 4.0 to 4.6 N.
const GROWTH: f64 = 10.0;
const PULL: f64 = 4.0;
/// How hard a part is pressed into the robot's open hand, N. Chosen by hand: enough for the wrist to feel, far below what
/// pushes the hand away.
const PUSH: f64 = 1.0;

impl Person {
    /// Goes on pulling or pushing for as long as there is something to pull at, or to push against.
    pub(crate) fn exert(&self, state: &mut PersonState, around: &Surroundings) {
        let (grip, robot) = (state.held.get(), &around.robot);
        let most = match state.phase() {
            _ if grip.is_none() => 0.0,
            ActivityPhase::AwaitRelease if robot.held == grip => PULL,
            ActivityPhase::Give if robot.held == grip || robot.receiving == grip => -PUSH,
            _ => 0.0,
        };
        state.contact_since = match state.contact_since {
            _ if most == 0.0 => 0,
            0 => around.tick.max(1),
            since => since,
        };
        let grown = GROWTH * PERIOD_S * around.tick.saturating_sub(state.contact_since) as f64;
        let force = grown.min(most.abs()).copysign(most);
        let towards = self.arm(state).towards_shoulder(self.arm(state).centre(&state.hand));
        state.force = (if most == 0.0 { DVec3::ZERO } else { force * towards }).into();
    }
}
