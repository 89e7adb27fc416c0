use super::PersonHand;
use super::Surroundings;
use super::part_track::{BY_PERSON, BY_ROBOT, PartTrack};
use nalgebra::Vector3;

/// Distance of the finger tips' middle from the centre of a part that they close on, m.
const CLOSED_ON: f64 = 0.045;
/// The same for a part that moves along with the hand.
const CARRIED: f64 = 0.06;
/// Distance at which a part is out of the hand, m.
const OUT: f64 = 0.09;
/// Thumb and index hold a part when they are no further apart than its width and this, m; and have let go of it when
/// they are further apart than its width and the second.
const CLOSED: f64 = 0.02;
const OPENED: f64 = 0.05;
/// Speed of a hand that closes on a part, m/s.
const SLOW: f64 = 0.15;
/// How long a part must lie still to show that a hand that leaves has let go of it, cycles.
const LEFT: u32 = 60;
/// Force that tells that the robot's fingers hold something, N.
const TOUCH: f64 = 0.2;
/// Distance of the robot's grasp point from the axis of the part that it holds, m; beyond twice that, it holds it not.
const GRASPED: f64 = 0.045;

/// What a track's kind is like.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Body {
    /// m.
    pub width: f64,
    /// m.
    pub height: f64,
}

impl PartTrack {
    /// Finds out anew who has the part. `airborne`: it hangs in the air, on nothing that could carry it.
    pub(super) fn find_holder(&mut self, body: Body, around: &Surroundings, airborne: bool) {
        let person = match around.person {
            Some(hand) => self.is_with_person(body, &hand),
            None => self.holder & BY_PERSON != 0,
        };
        let robot = around.touch > TOUCH && self.is_with_robot(body, around, airborne && !person);
        self.holder = u32::from(robot) * BY_ROBOT | u32::from(person) * BY_PERSON;
    }

    fn is_with_person(&self, body: Body, hand: &PersonHand) -> bool {
        let away = (self.above_underside(0.5 * body.height) - hand.centre).norm();
        if self.holder & BY_PERSON != 0 {
            let left = away > CARRIED && self.still >= LEFT;
            return !(away > OUT || left || hand.aperture > body.width + OPENED);
        }
        let closed = away < CLOSED_ON && hand.aperture < body.width + CLOSED && hand.speed < SLOW;
        let carried = away < CARRIED && self.still == 0 && hand.speed > SLOW && self.holder & BY_ROBOT == 0;
        closed || carried
    }

    fn is_with_robot(&self, body: Body, around: &Surroundings, airborne: bool) -> bool {
        let had = self.holder & BY_ROBOT != 0;
        match around.grasp_point {
            Some(point) => self.distance_to_axis(body, point) < if had { 2.0 * GRASPED } else { GRASPED },
            None => had || airborne,
        }
    }

    /// Distance of `point` from the part's axis, between its underside and its top, m.
    fn distance_to_axis(&self, body: Body, point: Vector3<f64>) -> f64 {
        let foot = Vector3::from(self.position);
        let axis = self.above_underside(body.height) - foot;
        let along = ((point - foot).dot(&axis) / axis.norm_squared().max(1e-12)).clamp(0.0, 1.0);
        (foot + axis * along - point).norm()
    }
}
