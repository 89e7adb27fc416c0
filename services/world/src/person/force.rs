//! What the person's hand exerts on the robot's, through a part that both have.

use super::actor::{Person, Surroundings};
use super::{PersonMemory, Stage};
use glam::DVec3;

/// Growth of the force, N/s, and how far the person pulls at a part that the robot does not let go, N. In the recorded
/// handover the force between the two people turns round with 11 N/s as the part changes hands, and stays at 4.0 to 4.6 N.
const GROWTH: f64 = 10.0;
const PULL: f64 = 4.0;
/// How hard a part is pressed into the robot's open hand, N.
const PUSH: f64 = 1.0;

impl Person {
    /// Goes on pulling or pushing for as long as there is something to pull at, or to push against.
    pub(super) fn exert(&self, memory: &mut PersonMemory, around: &Surroundings) {
        let grip = memory.grip;
        let most = match memory.stage() {
            _ if grip.get().is_none() => 0.0,
            Stage::AwaitRelease if around.robot.held == grip => PULL,
            Stage::Offer if around.robot.held == grip || around.robot.receiving == grip => -PUSH,
            _ => 0.0,
        };
        memory.contact = match memory.contact {
            _ if most == 0.0 => 0,
            0 => around.tick.max(1),
            since => since,
        };
        let grown = GROWTH * 1e-3 * around.tick.saturating_sub(memory.contact) as f64;
        let force = grown.min(most.abs()).copysign(most);
        let towards = self.model.towards_shoulder(self.model.centre(&memory.hand));
        memory.force = (if most == 0.0 { DVec3::ZERO } else { force * towards }).into();
    }
}
