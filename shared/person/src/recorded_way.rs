use coact_recordings::{Way, WayKind};
use glam::DVec3;

/// The course of a recorded way as a smooth curve.
#[derive(Debug, Clone)]
pub(crate) struct RecordedWay {
    pub kind: WayKind,
    /// From beginning to end, m.
    pub distance: f64,
    /// s.
    pub duration: f64,
    points: [DVec3; Way::POINTS],
}

impl RecordedWay {
    pub fn new(way: &Way) -> Self {
        let Way { kind, distance, duration, points, .. } = way;
        Self { kind: *kind, distance: *distance, duration: *duration, points: points.map(DVec3::from) }
    }

    /// Where the hand is at fraction `time` of the way's time: along, aside and up, in units of the distance.
    ///
    /// A cubic curve through the points, each left as the points beside it lie (Catmull and Rom 1974): velocity has no step. It
    /// begins and ends at rest, though the recorded hand still had a tenth of its speed there.
    pub fn at(&self, time: f64) -> DVec3 {
        let last = Way::POINTS - 1;
        let passed = time.clamp(0.0, 1.0) * last as f64;
        let before = (passed as usize).min(last - 1);
        let (from, to) = (self.points[before], self.points[before + 1]);
        let (leaving, arriving) = (self.slope(before), self.slope(before + 1));
        let part = passed - before as f64;
        let (square, left) = (part * part, 1.0 - part);
        let blend = square * (3.0 - 2.0 * part);
        from.lerp(to, blend) + part * left * left * leaving - square * left * arriving
    }

    /// Change from point to point at a point.
    fn slope(&self, point: usize) -> DVec3 {
        match point {
            0 => DVec3::ZERO,
            _ if point == Way::POINTS - 1 => DVec3::ZERO,
            _ => 0.5 * (self.points[point + 1] - self.points[point - 1]),
        }
    }
}
