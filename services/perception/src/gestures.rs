use crate::evidence::smooth_step;
use crate::grasps::OFFERED;
use crate::memory::Memory;
use crate::movement::Movement;
use coact_joint_task::{Gesture, Task};
use coact_messages::Percept;
use nalgebra::Vector3;

/// A gesture is shown this near to the handover place (m) and this slow (m/s): full, and no evidence.
const SHOWN: (f64, f64) = (0.17, 0.32);
const SHOWN_SPEED: (f64, f64) = (0.15, 0.50);
/// An open hand's aperture, m: no, full evidence.
const OPEN: (f64, f64) = (0.06, 0.085);
/// Scatter of the pitch of a gesture, rad.
const SCATTER: f64 = 0.35;
/// A hand this near to a part may be about to take it or to put it down, m.
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
        movement: Option<&Movement>,
        memory: &Memory,
        out: &Percept,
    ) -> f64 {
        let hand = &memory.hand;
        if !hand.is_tracked(tick) || self.is_about_a_part(memory) {
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
    fn is_about_a_part(&self, memory: &Memory) -> bool {
        memory.objects.parts().any(|(_, part)| {
            let place = Vector3::from(part.position);
            let offered = part.is_with_the_robot() && (place - self.handover).norm() < OFFERED;
            offered || (place - memory.hand.centre()).norm() < AT_PART
        })
    }
}
