use super::part_track::{BY_PERSON, FREE, MOVED, PartTrack};
use super::{Hands, Sight, TaskPlaces};
use crate::plausible_cycle::cycle;
use bytemuck::{Pod, Zeroable};
use coact_messages::{MAX_PARTS, SceneView, Sighting};
use coact_period::{cycles, seconds};
use coact_stage_state::{Implausible, bounded, ensure};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use std::time::Duration;

/// How far a part may have moved between two sightings, m: at the recogniser's 30 Hz, in a hand of 3.6 m/s.
const GATE: f64 = 0.12;
/// How far a part that is carried goes from one frame of the recogniser to the next, m: a hand at 1.5 m/s. Chosen by hand.
const GONE_ON: f64 = 0.05;
/// How long a part that is out of sight is taken to go along with the person's hand that has it, cycles. Chosen by hand: fingers that take
/// it from above hide it until they have brought it to its place, for about 1 s.
const CARRIED_UNSEEN: u64 = cycles(Duration::from_millis(1200));
/// How long a place must be in view and empty before its part is taken to be gone: ten frames of the recogniser, which
/// misses single ones.
const ABSENT: u32 = cycles(Duration::from_millis(350)) as u32;
/// How far from the origin a part may be sighted, m: none beyond it concerns the robot, the recogniser is mistaken.
const FARTHEST: f64 = 10.0;

/// All parts that have been sighted.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct PartTracks {
    /// Newest frame's number plus one; 0 before the first.
    seen: u64,
    /// Cycle at which it was captured.
    pub captured: u64,
    /// The robot's palm at the newest frame: place, m, and quaternion x, y, z, w; zeros: not known.
    palm: [f64; 7],
    /// The middle of the person's fingers then, m; zeros: not known.
    fingers: [f64; 3],
    /// No track from this index on is in use: most scenes have few parts, and they are gone through many times in each cycle.
    used: u64,
    tracks: [PartTrack; MAX_PARTS],
}

impl PartTracks {
    /// The parts that are followed now.
    pub fn parts(&self) -> impl Iterator<Item = (usize, &PartTrack)> + Clone {
        self.numbered().map(|(_, kind, track)| (kind, track))
    }

    /// The same, each with the index of its track.
    pub fn numbered(&self) -> impl Iterator<Item = (usize, usize, &PartTrack)> + Clone {
        let all = self.in_use().iter().enumerate();
        all.filter_map(|(index, track)| Some((index, track.believed_kind()?, track)))
    }

    fn in_use(&self) -> &[PartTrack] {
        &self.tracks[..(self.used as usize).min(MAX_PARTS)]
    }

    /// The part in the robot's hand: index of its track and kind.
    pub fn with_the_robot(&self) -> Option<(usize, usize)> {
        self.numbered().find(|(_, _, track)| track.is_with_the_robot()).map(|(index, kind, _)| (index, kind))
    }

    /// Whether the person has one.
    pub fn is_any_with_the_person(&self) -> bool {
        self.parts().any(|(_, part)| part.is_with_the_person())
    }

    /// Whether the part of `kind` that the person has, or had until just now, was mounted when she took it.
    pub fn is_taken_out(&self, kind: usize) -> bool {
        let own = self.parts().filter(|(own, _)| *own == kind);
        let held = own.clone().find(|(_, part)| part.is_with_the_person());
        held.map_or_else(|| own.clone().any(|(_, part)| part.is_taken_out()), |(_, part)| part.is_taken_out())
    }

    /// One track, if it is in use.
    pub fn track(&self, index: usize) -> Option<&PartTrack> {
        self.tracks.get(index).filter(|track| track.believed_kind().is_some())
    }

    /// Whether the kinds of part that they are about are among so many `kinds`.
    pub fn are_about(&self, kinds: usize) -> bool {
        self.tracks.iter().all(|track| track.is_about(kinds))
    }

    /// Refuses what is no state of them.
    pub fn check(&self) -> Result<(), Implausible> {
        ensure(self.seen > 0 || self.captured == 0, "parts.captured", "0 before the first frame")?;
        cycle("parts.captured", self.captured)?;
        bounded("parts.palm", &self.palm, FARTHEST)?;
        bounded("parts.fingers", &self.fingers, FARTHEST)?;
        let others = self.tracks.get(self.used as usize..);
        let unused = others.is_some_and(|others| others.iter().all(|track| track.kind().is_none()));
        ensure(unused, "parts.used", "no track in use from this index on")?;
        self.tracks.iter().try_for_each(PartTrack::check)
    }

    /// Whether the newest frame is young enough to tell what lies where.
    pub fn is_seeing(&self, tick: u64) -> bool {
        self.seen > 0 && tick.saturating_sub(self.captured) < 2 * u64::from(ABSENT)
    }

    /// Whether the recogniser's newest frame is a new and usable one.
    pub fn is_news(&self, tick: u64, view: &SceneView) -> bool {
        let late = self.seen > 0 && view.captured_cycle <= self.captured;
        self.seen != view.frame.wrapping_add(1) && !late && view.captured_cycle <= tick
    }

    /// Takes in a new frame of the recogniser.
    pub fn observe(&mut self, sight: &Sight, around: &Hands, places: &TaskPlaces) {
        let view = sight.view;
        let cycles = view.captured_cycle - self.captured;
        self.seen = view.frame.wrapping_add(1);
        self.captured = view.captured_cycle;
        let carries = around.person.map_or(Vector3::zeros(), |hand| hand.velocity * seconds(cycles));
        self.associate(view, cycles, places, carries);
        self.used =
            self.tracks.iter().rposition(|track| track.kind().is_some()).map_or(0, |last| last as u64 + 1);
        self.follow_robot(around.palm);
        self.follow_person(around.person.map(|hand| hand.centre));
        self.miss(sight, cycles, places);
        let counted = (0..places.kinds()).filter_map(|kind| Some((kind, places.count(kind)?)));
        counted.for_each(|(kind, most)| self.forget_surplus(kind, most));
        for (kind, track) in self.tracks.iter_mut().filter_map(|track| Some((track.kind()?, track))) {
            track.watch_fingers(places.size(kind), around, seconds(cycles));
        }
        self.find_holders(around, places);
    }

    /// Finds out who has which part: first what was let go, then what was taken.
    fn find_holders(&mut self, around: &Hands, places: &TaskPlaces) {
        let mut busy = FREE;
        for track in &mut self.tracks {
            if let Some(kind) = track.believed_kind() {
                track.look_whether(places.is_mounted(kind, track.position), around.followed);
                track.let_go(places.size(kind), around);
                busy |= track.holder;
            }
        }
        let nearest = self.nearest_to_fingers(around, places);
        for (index, track) in self.tracks.iter_mut().enumerate() {
            if let Some(kind) = track.believed_kind() {
                let airborne = places.is_airborne(kind, track.position);
                let beside = if nearest == Some(index) { FREE } else { BY_PERSON };
                track.take(!(busy | beside), places.size(kind), around, airborne, self.captured);
                busy |= track.holder;
            }
        }
    }

    /// The part that the person's fingers are nearest to, of those that they may be around: mounted parts stand side by side, and fingers
    /// that close on a small one are as wide as a large one before.
    fn nearest_to_fingers(&self, around: &Hands, places: &TaskPlaces) -> Option<usize> {
        let reached = self.numbered().filter_map(|(index, kind, track)| {
            let airborne = places.is_airborne(kind, track.position);
            track.reached_at(places.size(kind), around, airborne).map(|away| (index, away))
        });
        reached.min_by(|(_, one), (_, other)| one.total_cmp(other)).map(|(index, _)| index)
    }

    /// Gives every sighting to the nearest track of its kind, those of what lies still first; then to a part of another kind that is there, and may be
    /// mistaken for its own; then to one that may have moved there; what is left, to a new track, unless each part of that kind that there is has been
    /// seen in this frame: then it is none. The person `carries` what she holds so far in a frame, m.
    fn associate(&mut self, view: &SceneView, cycles: u64, places: &TaskPlaces, carries: Vector3<f64>) {
        let mut left = [None; MAX_PARTS];
        let plausible = view.sightings().iter().filter(|sighting| is_plausible(sighting, places));
        left.iter_mut().zip(plausible).for_each(|(left, sighting)| *left = Some(sighting));
        let mut give = |own: &mut Self, find: &dyn Fn(&Self, &Sighting) -> Option<usize>| {
            for left in &mut left {
                let found = left.and_then(|one| Some((one, find(own, one)?)));
                if let Some((sighting, index)) = found {
                    own.tracks[index].follow(sighting, own.captured, cycles);
                    *left = None;
                }
            }
        };
        give(self, &|own, sighting| own.nearest(sighting, MOVED, carries));
        give(self, &Self::at_its_place);
        give(self, &|own, sighting| own.nearest(sighting, GATE, carries));
        for sighting in left.into_iter().flatten() {
            if places.are_all_seen(sighting.kind as usize, self, self.captured) {
                continue;
            }
            if let Some(index) = self.tracks.iter().position(|track| track.kind().is_none()) {
                self.tracks[index] = PartTrack::new(sighting, self.captured);
            }
        }
    }

    /// The track of a part that no sighting of this frame was given to, and that is where this one of another kind is: no two parts lie so
    /// near to each other, not even one upon the other. One that is carried has gone on since.
    fn at_its_place(&self, sighting: &Sighting) -> Option<usize> {
        self.tracks.iter().position(|track| {
            let away = (Vector3::from(track.position) - Vector3::from(sighting.position)).norm();
            let far = if track.still == 0 || track.holder != FREE { GONE_ON } else { MOVED };
            track.kind().is_some() && track.seen < self.captured && away < far
        })
    }

    /// The track of the sighting's kind that lies nearest to it, within so many m, and has no sighting in this frame yet.
    /// One that the person holds is looked for where her hand, which `carries` it so far in a frame, m, has brought it.
    fn nearest(&self, sighting: &Sighting, within: f64, carries: Vector3<f64>) -> Option<usize> {
        let away = |track: &PartTrack| {
            let carried = if track.is_with_the_person() { carries } else { Vector3::zeros() };
            (Vector3::from(track.position) + carried - Vector3::from(sighting.position)).norm()
        };
        let waiting = |track: &PartTrack| {
            track.kind() == Some(sighting.kind as usize) && track.seen < self.captured && away(track) < within
        };
        let all = self.tracks.iter().enumerate().filter(|(_, track)| waiting(track));
        all.min_by(|(_, a), (_, b)| away(a).total_cmp(&away(b))).map(|(index, _)| index)
    }

    /// What the robot holds goes where its palm goes, seen or not.
    fn follow_robot(&mut self, palm: Option<Isometry3<f64>>) {
        if let (Some(before), Some(now)) = (pose(self.palm), palm) {
            let moved = now * before.inverse();
            let unseen = |track: &&mut PartTrack| track.is_with_the_robot() && track.seen < self.captured;
            self.tracks.iter_mut().filter(unseen).for_each(|track| track.go_along(&moved));
        }
        self.palm = palm.map_or([0.0; 7], pose_words);
    }

    /// What the person holds goes where her hand goes, also where it is not seen for a moment.
    fn follow_person(&mut self, fingers: Option<Vector3<f64>>) {
        let before = Some(Vector3::from(self.fingers)).filter(|before| *before != Vector3::zeros());
        if let (Some(before), Some(now)) = (before, fingers) {
            let moved = Translation3::from(now - before).into();
            let unseen = |track: &&mut PartTrack| {
                track.seen < self.captured && is_carried_unseen(track, self.captured)
            };
            self.tracks.iter_mut().filter(unseen).for_each(|track| track.go_along(&moved));
        }
        self.fingers = fingers.unwrap_or_default().into();
    }

    /// Gives up parts whose place has been in view and empty for long enough; those that were not believed in yet, at once. What the robot's
    /// fingers feel needs no eye, and where in the person's hand a part is that her fingers hide is not known as exactly as a view is empty.
    fn miss(&mut self, sight: &Sight, cycles: u64, places: &TaskPlaces) {
        for track in &mut self.tracks {
            let Some(kind) = track.kind().filter(|_| track.seen < self.captured) else { continue };
            let in_hand = track.is_with_the_robot() || is_carried_unseen(track, self.captured);
            if !in_hand && !sight.hides(track.upper_face(places.size(kind))) {
                track.absent = track.absent.saturating_add(cycles as u32);
            }
            if track.absent > ABSENT || !track.is_believed() {
                *track = PartTrack::zeroed();
            }
        }
    }

    /// There are no more parts of `kind` than so many: if more are believed in, one that is not seen has turned up elsewhere. Something may
    /// cover the place where it lay, for good.
    fn forget_surplus(&mut self, kind: usize, most: usize) {
        let own = self.numbered().filter(|(_, own, _)| *own == kind);
        if own.clone().count() > most {
            let unseen = own.filter(|(_, _, track)| {
                !track.is_held() && self.captured.saturating_sub(track.seen) > u64::from(ABSENT)
            });
            if let Some((index, _, _)) = unseen.min_by_key(|(_, _, track)| track.seen) {
                self.tracks[index] = PartTrack::zeroed();
            }
        }
    }
}

/// Whether the person has had the part in the hand, out of sight, for no longer than it is taken to be there.
fn is_carried_unseen(track: &PartTrack, captured: u64) -> bool {
    track.is_with_the_person() && captured.saturating_sub(track.seen) < CARRIED_UNSEEN
}

fn is_plausible(sighting: &Sighting, places: &TaskPlaces) -> bool {
    let near = sighting.position.iter().all(|value| value.abs() < FARTHEST);
    let norm: f64 = sighting.orientation.iter().map(|value| value * value).sum();
    let upright = (0.5..2.0).contains(&norm);
    (sighting.kind as usize) < places.kinds() && near && upright && sighting.confidence > 0.0
}

/// A pose in words, place and quaternion x, y, z, w; none in zeros.
fn pose([x, y, z, i, j, k, w]: [f64; 7]) -> Option<Isometry3<f64>> {
    let turn = UnitQuaternion::try_new(Quaternion::new(w, i, j, k), f64::EPSILON)?;
    Some(Isometry3::from_parts(Vector3::new(x, y, z).into(), turn))
}

/// The other way.
fn pose_words(pose: Isometry3<f64>) -> [f64; 7] {
    let ([x, y, z], [i, j, k, w]) = (pose.translation.vector.into(), pose.rotation.coords.into());
    [x, y, z, i, j, k, w]
}
