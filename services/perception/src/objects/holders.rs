use super::part_track::{BY_PERSON, BY_ROBOT, FREE, PartTrack, SETTLED};
use super::{Hands, PersonHand};
use nalgebra::Vector3;

/// Distance of the finger tips' middle from the centre of a part that they close on, m: half a large part, and scatter.
/// Chosen by hand, as all distances here: smaller ones miss grasps at a part's end, larger ones grasp the neighbour.
const CLOSED_ON: f64 = 0.045;
/// The same for a part that moves along with the hand, which is sighted up to a frame earlier or later than the hand.
const CARRIED: f64 = 0.06;
/// Distance at which a part is out of the hand, m.
const OUT: f64 = 0.09;
/// Thumb and index hold a part when they are no further apart than its width and this, m.
const CLOSED: f64 = 0.02;
/// They have let go of it when they are further apart than its width and this, m.
const OPENED: f64 = 0.05;
/// Thumb and index have closed on a part when they lately were further apart by this, while about it, m: several times what the tracker's
/// scatter makes of fingers that are still. People open theirs by 2 to 4 cm more than a part is wide, and close them on its last 8 cm; those of a
/// hand that goes back to rest close on all of its way.
const CLOSING: f64 = 0.012;
/// Distance from the centre of a part at which a hand's fingers are about it, m. Chosen by hand.
const ABOUT: f64 = 0.06;
/// How fast fingers close that close on a part, at least, m/s: what they were wider before counts for the less, the longer ago it was.
const CLOSES: f64 = 0.01;
/// Speed of a hand that closes on a part, m/s: that of a hand at rest, with the tracker's scatter.
const SLOW: f64 = 0.15;
/// How far a hand must be away that moves off from a part that has settled, and so has let go of it, m.
const LEFT: f64 = 0.035;
/// Force that tells that the robot's fingers hold something, N: above a sensor's noise, below the weight of a light part.
/// Chosen by hand.
pub(crate) const TOUCH: f64 = 0.2;
/// Distance of the robot's hand from the axis of the part that it holds, m; beyond twice that, it does not hold it.
const GRASPED: f64 = 0.045;
/// Pieces of the hand's axis at whose ends that is measured: they are shorter than a centimetre or two.
const ALONG: u32 = 8;

/// How large the parts of a kind are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PartSize {
    /// How far fingers close on it, m.
    pub width: f64,
    /// From its underside to its top, m.
    pub height: f64,
}

impl PartTrack {
    /// Its middle, m.
    pub fn centre(&self, size: PartSize) -> Vector3<f64> {
        self.above_underside(0.5 * size.height)
    }

    /// The middle of its upper face, m: whoever does not see that does not see the part.
    pub fn upper_face(&self, size: PartSize) -> Vector3<f64> {
        self.above_underside(size.height)
    }

    /// Follows how wide the person's fingers are about the part, `time` s after the last frame. Of a hand that is out of sight it is not known.
    pub(super) fn watch_fingers(&mut self, size: PartSize, around: &Hands, time: f64) {
        self.set_widest(match around.person {
            Some(hand) if self.away_from(size, &hand) > ABOUT => 0.0,
            // One that comes back to sight where it rests has taken nothing: it would have gone with it.
            Some(hand) if hand.rests && self.widest().is_infinite() => hand.aperture,
            Some(hand) => hand.aperture.max(self.widest() - CLOSES * time),
            None if around.unseen => f64::INFINITY,
            None => 0.0,
        });
    }

    /// Finds out whether a hand still has the part that it had.
    pub(super) fn let_go(&mut self, size: PartSize, around: &Hands) {
        if let Some(hand) = around.person
            && self.holder & BY_PERSON != 0
            && !self.stays_with_person(size, &hand)
        {
            self.holder &= !BY_PERSON;
        }
        if self.holder & BY_ROBOT != 0 && !self.stays_with_robot(size, around) {
            self.is_let_go_by_the_robot();
        }
    }

    /// Finds out whether a hand that is `free` takes the part: bits [`BY_ROBOT`] and [`BY_PERSON`]. A hand holds one part.
    /// `airborne`: the part hangs in the air, on nothing that could carry it. `captured`: cycle of the frame that tells.
    pub(super) fn take(&mut self, free: u32, size: PartSize, around: &Hands, airborne: bool, captured: u64) {
        if let Some(hand) = around.person.filter(|_| free & BY_PERSON != 0)
            && self.is_taken_by_person(size, &hand, airborne)
        {
            self.is_taken_by_the_person(captured);
        }
        let reached = around
            .hand_axis
            .map_or(airborne && self.holder == FREE, |axis| self.distance_to_hand(size, axis) < GRASPED);
        if free & BY_ROBOT != 0 && around.touch > TOUCH && reached {
            self.holder |= BY_ROBOT;
        }
    }

    fn stays_with_person(&self, size: PartSize, hand: &PersonHand) -> bool {
        let away = self.away_from(size, hand);
        let left = away > LEFT && self.still >= SETTLED && hand.speed > SLOW;
        !(away > OUT || left || hand.aperture > size.width + OPENED)
    }

    /// Distance from the fingers of a hand that it may be between, or carried by, m.
    pub(super) fn reached_at(&self, size: PartSize, around: &Hands, airborne: bool) -> Option<f64> {
        let hand = around.person?;
        let away = self.away_from(size, &hand);
        (away < CLOSED_ON || self.is_taken_by_person(size, &hand, airborne)).then_some(away)
    }

    /// By fingers that have closed around it, that are closed around it in the air, or that it goes along with. A hand that came to rest over it, as
    /// wide as it was on its way there, has not taken it.
    fn is_taken_by_person(&self, size: PartSize, hand: &PersonHand, airborne: bool) -> bool {
        let away = self.away_from(size, hand);
        let narrower = self.widest() - hand.aperture;
        let around = away < CLOSED_ON && hand.aperture < size.width + CLOSED;
        let closed = around && (narrower > CLOSING || airborne) && hand.speed < SLOW;
        let carried = away < CARRIED && self.still == 0 && hand.speed > SLOW && self.holder & BY_ROBOT == 0;
        closed || carried
    }

    fn stays_with_robot(&self, size: PartSize, around: &Hands) -> bool {
        let near = around.hand_axis.is_none_or(|axis| self.distance_to_hand(size, axis) < 2.0 * GRASPED);
        around.touch > TOUCH && near
    }

    fn away_from(&self, size: PartSize, hand: &PersonHand) -> f64 {
        (self.centre(size) - hand.centre).norm()
    }

    /// Distance of the part's axis from that of the robot's hand, m.
    pub fn distance_to_hand(&self, size: PartSize, [palm, grasp_point]: [Vector3<f64>; 2]) -> f64 {
        let points = (0..=ALONG).map(|step| palm.lerp(&grasp_point, f64::from(step) / f64::from(ALONG)));
        points.map(|point| self.distance_to_axis(size, point)).fold(f64::INFINITY, f64::min)
    }

    /// Distance of `point` from the part's axis, between its underside and its top, m.
    pub fn distance_to_axis(&self, size: PartSize, point: Vector3<f64>) -> f64 {
        let foot = Vector3::from(self.position);
        let axis = self.upper_face(size) - foot;
        let along = ((point - foot).dot(&axis) / axis.norm_squared().max(1e-12)).clamp(0.0, 1.0);
        (foot + axis * along - point).norm()
    }
}
