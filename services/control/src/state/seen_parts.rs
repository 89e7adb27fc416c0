use crate::sighting_frame::frame_of;
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_messages::{MAX_PARTS, SceneView, Sighting};
use coact_period::cycles;
use coact_stage_state::{Implausible, ensure};
use std::time::Duration;

/// Where parts are, by the newest camera frames: the recogniser misses some in each frame, and what it misses is still there.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct SeenParts {
    /// Those of the newest frame, in its order; then those that are missing in it.
    parts: [Sighting; MAX_PARTS],
    /// Cycle of the frame in which each was seen last.
    seen: [u64; MAX_PARTS],
    count: u64,
    /// Cycle of the newest frame.
    newest: u64,
}

/// What is not seen for so long is elsewhere, or hidden. Chosen by hand: 15 frames, all of which a recogniser that misses one
/// part in four misses once in 10⁹ times.
const FORGOTTEN: u64 = cycles(Duration::from_millis(500));
/// A part moves no farther than this from one frame to the next, m: as a hand carries it. One that seems to is another one of its kind.
const MOVES: f64 = 0.06;

impl SeenParts {
    /// Takes in a frame, once.
    pub fn see(&mut self, scene: &SceneView) {
        if scene.captured_cycle == self.newest {
            return;
        }
        let (before, mut missing) = (*self, [true; MAX_PARTS]);
        self.newest = scene.captured_cycle;
        self.count = 0;
        for part in scene.sightings() {
            before.nearest(part).into_iter().for_each(|old| missing[old] = false);
            self.remember(*part, self.newest);
        }
        for (index, part) in before.all().iter().enumerate().filter(|(index, _)| missing[*index]) {
            if self.newest.saturating_sub(before.seen[index]) < FORGOTTEN {
                self.remember(*part, before.seen[index]);
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

    pub fn check(&self) -> Result<(), Implausible> {
        ensure(self.count <= MAX_PARTS as u64, "seen.count", "a number of parts")
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

    fn remember(&mut self, part: Sighting, seen: u64) {
        let index = self.count as usize;
        if index < MAX_PARTS {
            (self.parts[index], self.seen[index]) = (part, seen);
            self.count += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        frames.iter().for_each(|(at, parts)| seen.see(&frame(*at, parts)));
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
        seen.see(&frame(33, &[one, other]));
        seen.see(&frame(66, &[other]));
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
