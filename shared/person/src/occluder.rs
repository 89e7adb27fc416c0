//! The occluder before a part whose taking the robot is not to see.

use crate::line_of_sight::box_before;
use crate::{HandMovement, PartsView, Person, PersonState, Surroundings};
use coact_joint_task::Task;
use coact_messages::KeypointName;
use glam::DVec3;

/// How far the occluder stands before what it hides, and how thick it is, m. Chosen by hand; not sensitive.
const GAP: f64 = 0.01;
const THICKNESS: f64 = 0.02;
/// How much wider and higher it is than what it hides, m: five times the scatter of the tracker.
const OVERLAP: f64 = 0.01;
/// Last part of a reach that is hidden as well, as a fraction of its time: the hand has all but arrived.
const ARRIVAL: f64 = 0.2;
/// Poses of the hand on it that are hidden. More change nothing: the hand moves slowly there.
const STEPS: u32 = 4;

impl Person {
    /// The occluder before the part of the present activity: centre and half extents, m. It hides the part, and the hand from
    /// the end of the reach on. None for an activity in full view, and where the hand would not be seen as it sets out.
    pub(crate) fn occluder(&self, state: &PersonState, around: &Surroundings) -> Option<[f64; 6]> {
        let part = state.part.get().filter(|_| state.variation.hidden.is_set())?;
        let HandMovement { start, end, .. } = state.movement;
        let arriving = |step: u32| {
            let before = ARRIVAL * f64::from(step) / f64::from(STEPS) * (end - start) as f64;
            state.movement.pose(end - before as u64)
        };
        let hand = |pose| self.arm(state).keypoints(&pose).into_iter().skip(KeypointName::Wrist as usize);
        let hands = (0..=STEPS).map(arriving).flat_map(hand);
        let places = hands.chain(corners(part, around.parts, around.task));
        let (eye, table) = (around.task.scene.eye(), around.task.scene.table_height);
        let hides =
            |occluder: &[f64; 6], place: DVec3| box_before(occluder, eye, place.into(), OVERLAP).is_some();
        board(eye.into(), table, places)
            .filter(|occluder| !hand(state.hand).any(|place| hides(occluder, place)))
    }
}

/// Corners of the box around a part, m.
fn corners(part: usize, parts: PartsView, task: &Task) -> impl Iterator<Item = DVec3> + Clone {
    let [x, y, z] = task.kinds[parts.kind(part)].shape.extents();
    let (at, turn) = (parts.position(part), parts.orientation(part));
    (0..8_u8).map(move |corner| {
        let side = |bit: u8| f64::from(corner >> bit & 1);
        at + turn * DVec3::new((side(0) - 0.5) * x, (side(1) - 0.5) * y, side(2) * z)
    })
}

/// The smallest upright board on the table top that stands across the line from `eye` to all `places` and hides them; none
/// when the eye is above them, so that no board does.
fn board(eye: DVec3, table: f64, places: impl Iterator<Item = DVec3> + Clone) -> Option<[f64; 6]> {
    let count = places.clone().count().max(1) as f64;
    let line = eye - places.clone().sum::<DVec3>() / count;
    let across = if line.x.abs() >= line.y.abs() { 0 } else { 1 };
    let towards = line[across].signum();
    let nearest = places.clone().map(|place| towards * place[across]).fold(f64::NEG_INFINITY, f64::max);
    let face = towards * (nearest + GAP);
    if towards * (eye[across] - face) <= THICKNESS {
        return None;
    }
    let seen_on_face =
        |place: DVec3| eye + (place - eye) * ((face - eye[across]) / (place[across] - eye[across]));
    let (mut low, mut high) = (DVec3::MAX, DVec3::MIN);
    for place in places.map(seen_on_face) {
        (low, high) = (low.min(place - OVERLAP), high.max(place + OVERLAP));
    }
    low.z = low.z.min(table);
    (low[across], high[across]) =
        (face.min(face + towards * THICKNESS), face.max(face + towards * THICKNESS));
    let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
    Some([centre.x, centre.y, centre.z, half.x, half.y, half.z])
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const EYE: DVec3 = DVec3::new(0.1, 0.3, 1.85);
    const AT: DVec3 = DVec3::new(-0.98, 0.02, 0.8);

    fn corners_around(middle: DVec3) -> impl Iterator<Item = DVec3> + Clone {
        (0..8_u8)
            .map(move |corner| middle + 0.05 * DVec3::from([0, 1, 2].map(|bit| f64::from(corner >> bit & 1))))
    }

    #[test]
    fn a_board_on_the_table_hides_all_places_and_nothing_beside_above_or_before_them() {
        let occluder = board(EYE, 0.8, corners_around(AT)).unwrap();
        let hidden = |place: DVec3| box_before(&occluder, EYE.into(), place.into(), 0.0).is_some();
        assert!(corners_around(AT).all(hidden), "{occluder:?}");
        for beside in [[0.0, 0.12, 0.0], [0.0, -0.07, 0.0], [0.0, 0.0, 0.16], [0.12, 0.0, 0.0]] {
            assert!(!hidden(AT + DVec3::from(beside)), "{beside:?} of {occluder:?}");
        }
        assert!((occluder[2] - occluder[5] - 0.8).abs() < 1e-9, "it stands on the table: {occluder:?}");
    }

    #[test]
    fn no_board_hides_from_an_eye_above() {
        assert_eq!(board(AT + DVec3::Z, 0.8, corners_around(AT)), None);
    }
}
