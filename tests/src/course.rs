use crate::checkout;
use coact_messages::KeypointName;
use coact_recordings::{Reach, read_folder};
use glam::DVec2;

/// How one person reached once: how far along the way, and how far beside it, as fractions of its length, over time.
#[derive(Debug, Clone)]
pub struct Course {
    points: Vec<(f64, DVec2)>,
}

/// Time before the labelled onset that belongs to a reach, s: the label comes when the hand has gone a fifth of its way.
const BEFORE: f64 = 0.2;
/// A reach of which less is seen is left out: frames, and length in the image, pixels.
const SEEN: (usize, f64) = (10, 50.0);

impl Course {
    /// All usable reaches of a person of the shipped recordings, in their order.
    ///
    /// # Panics
    /// There is no such person.
    pub fn of_person(person: u32) -> Vec<Self> {
        let reaches = read_folder(&checkout().join("data/reaches")).unwrap();
        let own = reaches.iter().filter(|reach| reach.participant == person);
        let courses: Vec<Self> = own.filter_map(Self::of).collect();
        assert!(courses.len() > 20, "person {person}: {} reaches", courses.len());
        courses
    }

    /// The wrist's way from before the onset to the grasp; none where it was lost.
    fn of(reach: &Reach) -> Option<Self> {
        let wrist = KeypointName::Wrist as usize;
        let frames =
            reach.frames.iter().filter(|frame| (-BEFORE..=reach.movement_time).contains(&frame.time));
        let seen: Vec<(f64, DVec2)> = frames
            .filter(|frame| frame.joints[wrist].confidence > 0.0)
            .map(|frame| (frame.time + BEFORE, DVec2::new(frame.joints[wrist].x, frame.joints[wrist].y)))
            .collect();
        let ((_, from), (_, to)) = (*seen.first()?, *seen.last()?);
        let way = to - from;
        if seen.len() < SEEN.0 || way.length() < SEEN.1 {
            return None;
        }
        let fraction =
            |at: DVec2| DVec2::new((at - from).dot(way), way.perp_dot(at - from)) / way.length_squared();
        Some(Self { points: seen.iter().map(|(time, at)| (*time, fraction(*at))).collect() })
    }

    /// How long it took, s.
    pub fn duration(&self) -> f64 {
        self.points.last().map_or(0.0, |(time, _)| *time)
    }

    /// Where it was after `time` s on a way between these places.
    pub fn between(&self, from: DVec2, to: DVec2, time: f64) -> DVec2 {
        let way = to - from;
        let fraction = self.at(time);
        from + fraction.x * way + fraction.y * way.perp()
    }

    fn at(&self, time: f64) -> DVec2 {
        let next = self.points.partition_point(|(then, _)| *then <= time);
        match (next.checked_sub(1).map(|last| self.points[last]), self.points.get(next)) {
            (Some((from, one)), Some((to, other))) => one.lerp(*other, (time - from) / (to - from)),
            (None, Some((_, first))) => *first,
            _ => DVec2::X,
        }
    }
}
