//! Where movements of a hand begin and end, by its speed.

use std::ops::Range;

/// A hand that is faster moves, m/s. Chosen by hand: that of somebody who stands sways with a third of it.
const MOVES: f64 = 0.1;
/// A minimum of speed below this fraction of both peaks beside it divides two movements.
const DIVIDES: f64 = 0.4;
/// A movement begins and ends where its speed is down to this fraction of its peak.
const ENDS: f64 = 0.1;

/// The movements, first to last frame each, in the order of time.
pub(crate) fn movements(speeds: &[Option<f64>]) -> Vec<Range<usize>> {
    let speed = |frame: usize| speeds[frame].unwrap_or(0.0);
    let mut found = Vec::new();
    let mut frame = 0;
    while frame < speeds.len() {
        let begin = frame;
        while frame < speeds.len() && speed(frame) > MOVES {
            frame += 1;
        }
        if frame > begin {
            divide(begin..frame, &speed, &mut found);
        }
        frame = frame.max(begin + 1);
    }
    found.into_iter().map(|own| lengthened(own, speeds)).collect()
}

/// The frame of the movement in which the hand is fastest.
pub(crate) fn peak(movement: &Range<usize>, speeds: &[Option<f64>]) -> usize {
    let fastest = movement
        .clone()
        .max_by(|one, other| speeds[*one].unwrap_or(0.0).total_cmp(&speeds[*other].unwrap_or(0.0)));
    fastest.unwrap_or(movement.start)
}

/// Divides a stretch at its relatively deepest minimum, and both sides of it again.
fn divide(stretch: Range<usize>, speed: &impl Fn(usize) -> f64, found: &mut Vec<Range<usize>>) {
    let highest = |frames: Range<usize>| frames.map(speed).fold(0.0, f64::max);
    let depth = |frame: usize| {
        let beside = highest(stretch.start..frame).min(highest(frame + 1..stretch.end));
        if beside > 0.0 { speed(frame) / beside } else { f64::INFINITY }
    };
    let deepest = stretch.clone().min_by(|one, other| depth(*one).total_cmp(&depth(*other)));
    match deepest.filter(|frame| depth(*frame) < DIVIDES) {
        Some(frame) => {
            divide(stretch.start..frame, speed, found);
            divide(frame..stretch.end, speed, found);
        }
        None => found.push(stretch),
    }
}

/// The movement with what belongs to it before and after it is fast: as long as the hand grows faster, or slower.
fn lengthened(movement: Range<usize>, speeds: &[Option<f64>]) -> Range<usize> {
    let least = ENDS * speeds[peak(&movement, speeds)].unwrap_or(0.0);
    let goes_on = |frame: usize, next: usize| match (speeds[frame], speeds[next]) {
        (Some(now), Some(then)) => now > least && then < now,
        _ => false,
    };
    let Range { mut start, mut end } = movement;
    while start > 0 && goes_on(start, start - 1) {
        start -= 1;
    }
    while end < speeds.len() && goes_on(end - 1, end) {
        end += 1;
    }
    start..end
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Speeds of movements of minimum jerk with these peaks (m/s), 100 frames each.
    fn strokes(peaks: &[f64]) -> Vec<Option<f64>> {
        let stroke = |peak: &f64| {
            let peak = *peak;
            (0..100).map(move |frame| {
                let time = f64::from(frame) / 100.0;
                Some(peak * 16.0 * time * time * (1.0 - time) * (1.0 - time))
            })
        };
        peaks.iter().flat_map(stroke).collect()
    }

    #[test]
    fn each_stroke_is_a_movement_from_a_tenth_of_its_peak_to_a_tenth() {
        let found = movements(&strokes(&[0.8, 0.05, 0.5]));
        assert_eq!(found.len(), 2, "{found:?}");
        for (own, whole) in found.iter().zip([0..100, 200..300]) {
            assert!(own.start >= whole.start && own.end <= whole.end, "{own:?}");
            assert!((76..90).contains(&own.len()), "{own:?}");
        }
    }

    #[test]
    fn a_deep_minimum_divides_and_a_shallow_one_does_not() {
        let slowed = |least: f64| {
            let speed = |frame: i32| {
                let off = (f64::from(frame) / 50.0 - 1.0).abs();
                Some((least + off * 0.8) * if (1..100).contains(&frame) { 1.0 } else { 0.0 })
            };
            movements(&(0..=100).map(speed).collect::<Vec<_>>()).len()
        };
        assert_eq!((slowed(0.2), slowed(0.7)), (2, 1));
    }

    #[test]
    fn a_lost_frame_ends_a_movement() {
        let mut speeds = strokes(&[0.8]);
        speeds[50] = None;
        assert_eq!(movements(&speeds).iter().filter(|own| own.contains(&50)).count(), 0);
    }
}
