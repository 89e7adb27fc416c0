//! Where parts are, by the newest camera frames of the recogniser.
//!
//! It misses some in each frame, and others are hidden: by a board, by the person's arm, by the robot's own. What is not seen is taken to be
//! where it was, until its place is seen bare.
//!
//! ```
//! use coact_joint_task::Task;
//! use coact_messages::{SceneView, Sighting};
//! use coact_seen_parts::SeenParts;
//!
//! let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config/tasks/toy-vehicle.toml");
//! let task = Task::load(file.as_ref())?;
//! let mut view: Box<SceneView> = bytemuck::zeroed_box();
//! (view.captured_cycle, view.sightings) = (33, 1);
//! view.sighting[0] = Sighting { position: [-0.9, 0.3, 0.8], ..Sighting::default() };
//! let mut parts = SeenParts::none();
//! parts.see(&view, &task);
//!
//! // The next frame misses it.
//! (view.captured_cycle, view.sightings) = (66, 0);
//! parts.see(&view, &task);
//! assert_eq!(parts.all().len(), 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod sighting_frame;

pub use sighting_frame::{SHORTEST, frame_of};

use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_joint_task::Task;
use coact_messages::{MAX_PARTS, SceneView, Sighting};
use coact_period::cycles;
use coact_stage_state::{Implausible, ensure};
use nalgebra::{Point3, Vector3};
use std::time::Duration;

/// All parts that are seen, or were and may still be there. Words of a stage's state.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub struct SeenParts {
    /// Those of the newest frame, in its order; then those that are missing in it.
    parts: [Sighting; MAX_PARTS],
    /// Cycle of the frame in which each was seen last.
    seen: [u64; MAX_PARTS],
    /// Cycle of the frame before its place was seen bare, or of the newest one.
    covered: [u64; MAX_PARTS],
    /// How many frames have shown it.
    frames: [u64; MAX_PARTS],
    count: u64,
    /// Cycle of the newest frame.
    newest: u64,
}

/// A part whose place is seen bare for so long is elsewhere. Chosen by hand: 15 frames, all of which a recogniser that misses one part
/// in four misses once in 10⁹ times.
const FORGOTTEN: u64 = cycles(Duration::from_millis(500));
/// Frames that must have shown a part for it to be surely one of its kind: a recogniser takes one for one of another kind for some frames at a time.
const SURE: u64 = 15;
/// Frames that must have shown a part for it to stay where something hides it: a recogniser sees one now and then where there is none.
const BELIEVED: u64 = 3;
/// A part moves no farther than this from one frame to the next, m: as a hand carries it. One that seems to is another one of its kind.
const MOVES: f64 = 0.06;
/// How high above the table top a part may be and still lie on it, and how near to its place it is in it, m: a few centimetres. Chosen by hand.
const ON_TABLE: f64 = 0.05;
const IN_PLACE: f64 = 0.03;

impl SeenParts {
    /// None: no frame has come yet.
    pub fn none() -> Self {
        Self::zeroed()
    }

    /// Takes in a frame of this task's parts, once. One that is older than the newest begins anew: time has gone back.
    pub fn see(&mut self, scene: &SceneView, task: &Task) {
        if scene.captured_cycle == self.newest {
            return;
        }
        if scene.captured_cycle < self.newest {
            *self = Self::none();
        }
        let (before, mut missing) = (*self, [true; MAX_PARTS]);
        self.newest = scene.captured_cycle;
        self.count = 0;
        for part in scene.sightings() {
            let old = before.nearest(part);
            old.into_iter().for_each(|old| missing[old] = false);
            let frames = old.map_or(0, |old| before.frames[old]).saturating_add(1);
            self.remember(*part, [self.newest, self.newest, frames]);
        }
        let in_view = *self;
        for (index, part) in before.all().iter().enumerate().filter(|(index, _)| missing[*index]) {
            let may_be = before.frames[index] >= BELIEVED && !in_view.has_all(part.kind, task);
            let is_there = may_be && lies(task, part) && hides(scene, task, part);
            let covered = if is_there { self.newest } else { before.covered[index] };
            if self.newest.saturating_sub(covered) < FORGOTTEN {
                self.remember(*part, [before.seen[index], covered, before.frames[index]]);
            }
        }
    }

    /// The parts: those of the newest frame first, in its order.
    pub fn all(&self) -> &[Sighting] {
        &self.parts[..(self.count as usize).min(MAX_PARTS)]
    }

    /// The same, each with the cycle of the frame that showed it last.
    pub fn with_cycles(&self) -> impl Iterator<Item = (&Sighting, u64)> {
        self.all().iter().zip(self.seen)
    }

    /// Whether a part that was `seen` last in that cycle has been out of sight for longer than a recogniser misses one.
    pub fn is_covered_since(&self, seen: u64) -> bool {
        self.newest.saturating_sub(seen) >= FORGOTTEN
    }

    /// Refuses what is none.
    ///
    /// # Errors
    /// What is implausible of it.
    pub fn check(&self) -> Result<(), Implausible> {
        ensure(self.count <= MAX_PARTS as u64, "seen.count", "a number of parts")
    }

    /// Whether as many parts of a kind as there are have been seen for long, so that one which is not seen has become one of them.
    fn has_all(&self, kind: u32, task: &Task) -> bool {
        let sure =
            self.all().iter().zip(self.frames).filter(|(own, frames)| own.kind == kind && *frames >= SURE);
        task.count(kind as usize).is_some_and(|count| sure.count() >= count)
    }

    /// Which of them that part is.
    fn nearest(&self, part: &Sighting) -> Option<usize> {
        let place = frame_of(part)?.translation.vector;
        let same = self.all().iter().enumerate().filter(|(_, own)| own.kind == part.kind);
        let distances =
            same.filter_map(|(index, own)| Some((index, (frame_of(own)?.translation.vector - place).norm())));
        let nearest = distances.min_by(|one, other| one.1.total_cmp(&other.1));
        nearest.filter(|(_, distance)| *distance < MOVES).map(|(index, _)| index)
    }

    fn remember(&mut self, part: Sighting, [seen, covered, frames]: [u64; 3]) {
        let index = self.count as usize;
        if index < MAX_PARTS {
            (self.parts[index], self.seen[index]) = (part, seen);
            (self.covered[index], self.frames[index]) = (covered, frames);
            self.count += 1;
        }
    }
}

/// Whether a part lies on the table or is in its place: one in the air is in a hand, and goes with it.
fn lies(task: &Task, part: &Sighting) -> bool {
    let at = Vector3::from(part.position);
    let in_place = task.subgoals.iter().any(|goal| (Vector3::from(goal.socket) - at).norm() < IN_PLACE);
    in_place || at.z < task.scene.table_height + ON_TABLE
}

/// Whether the eye may not see such a part where it was. Where there is no depth camera, nothing tells: it is forgotten in time.
pub fn hides(scene: &SceneView, task: &Task, part: &Sighting) -> bool {
    let height = task.kinds.get(part.kind as usize).map_or(0.0, |kind| kind.shape.height());
    let face = frame_of(part).map(|frame| frame * Point3::new(0.0, 0.0, height));
    let hides = |face: Point3<f64>| scene.surface.hides(task.scene.eye(), face.coords.into());
    scene.surface.grid.used() > 0 && face.is_none_or(hides)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use coact_messages::{SiteGrid, UNMEASURED};
    use std::path::Path;

    fn task() -> Task {
        Task::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml"))
            .unwrap()
    }

    fn sighting(kind: u32, x: f64) -> Sighting {
        Sighting { kind, position: [x, 0.0, 0.0], orientation: [0.0, 0.0, 0.0, 1.0], ..Sighting::default() }
    }

    fn frame(captured_cycle: u64, parts: &[Sighting]) -> SceneView {
        let mut scene = SceneView { captured_cycle, sightings: parts.len() as u32, ..Zeroable::zeroed() };
        scene.sighting[..parts.len()].copy_from_slice(parts);
        scene
    }

    fn after(frames: &[(u64, &[Sighting])]) -> Vec<(u32, f64)> {
        let mut seen = SeenParts::zeroed();
        let task = task();
        frames.iter().for_each(|(at, parts)| seen.see(&frame(*at, parts), &task));
        seen.all().iter().map(|part| (part.kind, part.position[0])).collect()
    }

    #[test]
    fn what_a_frame_misses_is_still_there_and_stands_last() {
        let [one, other, third] = [sighting(0, 0.0), sighting(0, 0.1), sighting(1, 0.0)];
        let all: &[Sighting] = &[one, other, third];
        assert_eq!(after(&[(33, all), (66, &[other, third])]), [(0, 0.1), (1, 0.0), (0, 0.0)]);
        assert_eq!(after(&[(33, all), (66, &[]), (99, &[])]), [(0, 0.0), (0, 0.1), (1, 0.0)]);
        assert_eq!(after(&[(33, all), (66, &[other]), (99, all)]), [(0, 0.0), (0, 0.1), (1, 0.0)]);
    }

    #[test]
    fn each_has_the_cycle_of_the_frame_that_showed_it_last() {
        let [one, other] = [sighting(0, 0.0), sighting(1, 0.1)];
        let mut seen = SeenParts::zeroed();
        seen.see(&frame(33, &[one, other]), &task());
        seen.see(&frame(66, &[other]), &task());
        let cycles: Vec<_> = seen.with_cycles().map(|(part, cycle)| (part.kind, cycle)).collect();
        assert_eq!(cycles, [(1, 66), (0, 33)]);
    }

    #[test]
    fn of_two_that_are_near_to_each_other_the_one_that_is_missing_is_remembered() {
        let [one, other] = [sighting(0, 0.0), sighting(0, 0.05)];
        assert_eq!(after(&[(33, &[one, other]), (66, &[sighting(0, 0.047)])]), [(0, 0.047), (0, 0.0)]);
        assert_eq!(after(&[(33, &[one, other]), (66, &[sighting(0, 0.003)])]), [(0, 0.003), (0, 0.05)]);
    }

    #[test]
    fn one_that_moves_is_no_second_one() {
        let carried: Vec<_> = (0..20).map(|step: u32| [sighting(0, 0.05 * f64::from(step))]).collect();
        let frames: Vec<(u64, &[Sighting])> =
            carried.iter().zip(1..).map(|(parts, at)| (33 * at, &parts[..])).collect();
        assert_eq!(after(&frames), [(0, 0.05 * 19.0)]);
    }

    #[test]
    fn what_something_hides_stays_where_it_was_until_its_place_is_seen_bare() {
        let task = task();
        let [x, y] = task.scene.table_centre;
        let part = Sighting { position: [x, y, task.scene.table_height], ..sighting(0, 0.0) };
        let (mut seen, mut view) = (SeenParts::none(), frame(33, &[part]));
        view.surface.grid = SiteGrid { first: [x - 0.5, y - 0.5], spacing: [0.02; 2], sites: [51, 51] };
        view.surface.level = task.scene.table_height;
        let mut look = |sightings: u32, frames: u64, height: u8| {
            view.sightings = sightings;
            view.surface.height.fill(height);
            for _ in 0..frames {
                view.captured_cycle += 33;
                seen.see(&view, &task);
            }
            seen.all().len()
        };
        assert_eq!(look(1, 3, 0), 1);
        assert_eq!(look(0, 1_000, 40), 1, "an arm is before it");
        assert_eq!(look(0, 1_000, UNMEASURED), 1, "the picture does not tell");
        assert_eq!(look(0, 14, 0), 1, "a recogniser misses one now and then");
        assert_eq!(look(0, 2, 0), 0, "it is elsewhere");
        assert_eq!((look(1, 2, 0), look(0, 16, 40)), (1, 0), "it was not there");
    }

    #[test]
    fn what_something_hides_is_elsewhere_once_all_of_its_kind_are_seen() {
        let task = task();
        let single = (0..task.kinds.len()).find(|kind| task.count(*kind) == Some(1)).unwrap() as u32;
        let [x, y] = task.scene.table_centre;
        let at =
            |aside| Sighting { position: [x, y + aside, task.scene.table_height], ..sighting(single, 0.0) };
        let (mut seen, mut view) = (SeenParts::none(), frame(33, &[at(0.0)]));
        view.surface.grid = SiteGrid { first: [x - 0.5, y - 0.5], spacing: [0.02; 2], sites: [51, 51] };
        view.surface.height.fill(UNMEASURED);
        let mut look = |frames: u64, sightings: &[Sighting]| {
            view.sightings = sightings.len() as u32;
            view.sighting[..sightings.len()].copy_from_slice(sightings);
            for _ in 0..frames {
                view.captured_cycle += 33;
                seen.see(&view, &task);
            }
            seen.all().len()
        };
        assert_eq!(look(20, &[at(0.0)]), 1);
        assert_eq!(look(SURE - 1, &[at(0.3)]), 2, "a recogniser may be mistaken for so long");
        assert_eq!(look(100, &[]), 2, "one that is seen no more");
        assert_eq!(look(SURE + 16, &[at(0.3)]), 1);
    }

    #[test]
    fn what_a_hand_carries_behind_something_does_not_stay_in_the_air() {
        let task = task();
        let [x, y] = task.scene.table_centre;
        let part = Sighting { position: [x, y, task.scene.table_height + 0.2], ..sighting(0, 0.0) };
        let (mut seen, mut view) = (SeenParts::none(), frame(33, &[part]));
        view.surface.grid = SiteGrid { first: [x - 0.5, y - 0.5], spacing: [0.02; 2], sites: [51, 51] };
        view.surface.height.fill(UNMEASURED);
        seen.see(&view, &task);
        (view.sightings, view.captured_cycle) = (0, 33 + FORGOTTEN);
        seen.see(&view, &task);
        assert!(seen.all().is_empty());
    }

    #[test]
    fn when_time_goes_back_all_begins_anew() {
        let (one, other): (&[Sighting], &[Sighting]) = (&[sighting(0, 0.0)], &[sighting(1, 0.0)]);
        assert_eq!(after(&[(66, one), (33, other)]), [(1, 0.0)]);
    }

    #[test]
    fn it_is_forgotten_in_time_and_no_more_are_kept_than_there_is_room_for() {
        let one: &[Sighting] = &[sighting(0, 0.0)];
        assert_eq!(after(&[(33, one), (33 + FORGOTTEN - 1, &[])]), [(0, 0.0)]);
        assert_eq!(after(&[(33, one), (33 + FORGOTTEN, &[])]), []);
        let row =
            |from: f64| -> Vec<_> { (0..MAX_PARTS).map(|index| sighting(0, from + index as f64)).collect() };
        let (near, far) = (row(0.0), row(0.5));
        assert_eq!(after(&[(33, &near), (66, &far)]).len(), MAX_PARTS);
    }
}
