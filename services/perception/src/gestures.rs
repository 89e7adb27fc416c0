use crate::evidence::smooth_step;
use crate::grasps::OFFERED;
use crate::perception_state::PerceptionState;
use crate::present_movement::PresentMovement;
use coact_joint_task::{Gesture, Task};
use coact_messages::Percept;
use nalgebra::Vector3;

/// Distance from the handover place at which a gesture is shown, m: full, and no evidence. Chosen by hand.
const SHOWN: (f64, f64) = (0.17, 0.32);
/// Speed of a hand that shows one, m/s: full, and no evidence. Chosen by hand: a hand that passes by is faster.
const SHOWN_SPEED: (f64, f64) = (0.15, 0.50);
/// Aperture of an open hand, m: no, and full evidence. Chosen by hand: a relaxed
/// hand is narrower.
const OPEN: (f64, f64) = (0.06, 0.085);
/// Scatter of the pitch of a gesture, rad. Chosen by hand: gestures are held less exactly than grips.
const SCATTER: f64 = 0.35;
/// A hand this near to a part may be about to take it or to put it down, m: a finger's length.
const AT_PART: f64 = 0.07;

/// Makes evidence for gestures of the empty hand, held out where parts change hands.
#[derive(Debug, Clone)]
pub(crate) struct Gestures {
    gestures: Vec<Gesture>,
    handover: Vector3<f64>,
}

impl Gestures {
    pub fn new(task: &Task) -> Self {
        Self { gestures: task.gestures.clone(), handover: task.scene.handover.into() }
    }

    /// Evidence in [0, 1] that the hand shows gesture `index`.
    ///
    /// A hand that comes from rest straight to the handover place is on its way to show it; any other must be slow there.
    pub fn evidence(
        &self,
        index: usize,
        tick: u64,
        movement: Option<&PresentMovement>,
        state: &PerceptionState,
        out: &Percept,
    ) -> f64 {
        let hand = &state.hand;
        if !hand.is_tracked(tick) || self.is_about_a_part(state) {
            return 0.0;
        }
        let away = (hand.centre() - self.handover).norm();
        let near = smooth_step(away, SHOWN.1, SHOWN.0);
        let from_rest = movement.filter(|movement| movement.phase.is_some());
        let comes = from_rest.map_or(0.0, |movement| movement.heading.leads_to(self.handover));
        let slow = smooth_step(hand.velocity().norm(), SHOWN_SPEED.1, SHOWN_SPEED.0);
        let open = smooth_step(hand.aperture(), OPEN.0, OPEN.1);
        let miss = hand.pitch().map_or(0.0, |pitch| (pitch - self.gestures[index].pitch) / SCATTER);
        let empty = 1.0 - out.person_holds.iter().copied().fold(0.0, f64::max);
        near * slow.max(comes) * open * empty * (-0.5 * miss * miss).exp()
    }

    /// Whether a part lies at the hand, or the robot offers one.
    fn is_about_a_part(&self, state: &PerceptionState) -> bool {
        state.parts.parts().any(|(_, part)| {
            let place = Vector3::from(part.position);
            let offered = part.is_with_the_robot() && (place - self.handover).norm() < OFFERED;
            offered || (place - state.hand.centre()).norm() < AT_PART
        })
    }
}
