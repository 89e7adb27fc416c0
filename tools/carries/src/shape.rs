//! What is kept of a movement: its course in the frame of the straight line from its beginning to its end.

use crate::LeftOut;
use crate::hand_course::HandCourse;
use coact_recordings::Way;
use glam::DVec3;
use std::ops::RangeInclusive;

/// Shortest distance, m, and time, s.
const SHORTEST: (f64, f64) = (0.15, 0.3);
/// Longest time, s, and greatest speed, m/s, of a transport: of those of the recorded hands that do not strike, the fastest had
/// 1.03 m/s.
const TRANSPORT: (f64, f64) = (3.0, 1.2);
/// Longest path, in units of the distance.
const LONGEST_PATH: f64 = 1.5;
/// How far along the line a way may lead, in units of the distance.
const ALONG: RangeInclusive<f64> = -0.02..=1.02;
/// Sine of the steepest line.
const STEEPEST: f64 = 0.95;

/// Distance, m, time, s, and points of a movement from its first to its last frame.
pub(crate) struct Shape {
    pub distance: f64,
    pub duration: f64,
    pub points: [[f64; 3]; Way::POINTS],
}

impl Shape {
    /// That of the movement whose fastest speed is `peak`, m/s.
    pub fn of(course: &HandCourse, [first, last]: [usize; 2], peak: f64) -> Result<Self, LeftOut> {
        let places: Option<Vec<DVec3>> = course.places[first..=last].iter().copied().collect();
        let places = places.ok_or(LeftOut::Lost)?;
        let (from, line) = (places[0], places[places.len() - 1] - places[0]);
        let (distance, duration) = (line.length(), course.times[last] - course.times[first]);
        if distance < SHORTEST.0 || duration < SHORTEST.1 {
            return Err(LeftOut::Short);
        }
        if duration > TRANSPORT.0 || peak > TRANSPORT.1 {
            return Err(LeftOut::NoTransport);
        }
        let along = line / distance;
        let path: f64 = places.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let leads_on = |place: &DVec3| ALONG.contains(&((place - from).dot(along) / distance));
        if path > LONGEST_PATH * distance || !places.iter().all(leads_on) {
            return Err(LeftOut::Detour);
        }
        if along.z.abs() > STEEPEST {
            return Err(LeftOut::Steep);
        }
        let up = DVec3::Z.reject_from_normalized(along).normalize();
        let axes = [along, along.cross(up), up];
        let points = std::array::from_fn(|point| match point {
            0 => Way::BEGINNING,
            _ if point == Way::POINTS - 1 => Way::END,
            _ => {
                let time = course.times[first] + duration * point as f64 / (Way::POINTS - 1) as f64;
                let reached = between(&course.times[first..=last], &places, time) - from;
                axes.map(|axis| rounded(reached.dot(axis) / distance, 1e4))
            }
        });
        Ok(Self { distance: rounded(distance, 1e4), duration: rounded(duration, 1e2), points })
    }
}

/// Where the hand was at `time`, between two frames.
fn between(times: &[f64], places: &[DVec3], time: f64) -> DVec3 {
    let next = times.partition_point(|own| *own <= time).clamp(1, times.len() - 1);
    let along = (time - times[next - 1]) / (times[next] - times[next - 1]);
    places[next - 1].lerp(places[next], along)
}

/// As many digits as the file holds; no negative zero.
fn rounded(value: f64, digits: f64) -> f64 {
    (value * digits).round() / digits + 0.0
}
