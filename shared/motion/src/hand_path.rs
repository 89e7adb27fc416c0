use crate::{Mechanism, Plan};
use nalgebra::{Point3, Vector3};

/// The path of the hand in a movement, with its speed: what an observer sees, and what movements are measured by.
#[derive(Debug, Clone, PartialEq)]
pub struct HandPath {
    /// Places of the grasp point at equal steps of time, m, world.
    pub places: Vec<Point3<f64>>,
    /// Time between them, s.
    pub step: f64,
    /// Speeds between them, m/s.
    pub speed: Vec<f64>,
}

/// A valley between two peaks of speed counts when it lies below this fraction of both. Chosen by hand: it ignores ripples.
const VALLEY: f64 = 0.9;
/// Peaks below this fraction of the highest do not count. Chosen by hand.
const LEAST_PEAK: f64 = 0.1;
/// Shortest path by which jerk is divided, m: it only guards a division.
const TINY_LENGTH: f64 = 1e-9;

impl HandPath {
    /// Of a plan, at `count` + 1 places.
    pub fn of(mechanism: &Mechanism, plan: &Plan, count: usize) -> Self {
        let step = plan.duration() / count as f64;
        let place = |place: usize| {
            let posture = plan.at(place as f64 * step).map(|state| state.position);
            mechanism.arm.palm(&posture) * mechanism.grasp_point()
        };
        let places: Vec<_> = (0..=count).map(place).collect();
        let speed = places.windows(2).map(|pair| (pair[1] - pair[0]).norm() / step).collect();
        Self { places, step, speed }
    }

    /// Its length, m.
    pub fn length(&self) -> f64 {
        self.speed.iter().sum::<f64>() * self.step
    }

    /// Normalised jerk: sqrt(1/2 integral of jerk² x T⁵ / L²); 19 (the root of 360) for a straight movement of minimum jerk.
    pub fn normalised_jerk(&self) -> f64 {
        let places: Vec<Vector3<f64>> = self.places.iter().map(|place| place.coords).collect();
        let difference = |values: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
            values.windows(2).map(|pair| (pair[1] - pair[0]) / self.step).collect()
        };
        let jerk = difference(&difference(&difference(&places)));
        let energy: f64 = jerk.iter().map(|jerk| jerk.norm_squared() * self.step).sum();
        let duration = self.step * (self.places.len() - 1) as f64;
        (0.5 * energy * duration.powi(5)).sqrt() / self.length().max(TINY_LENGTH)
    }

    /// Movement units: rises and falls of its speed.
    pub fn units(&self) -> u32 {
        units(&self.speed)
    }
}

/// Peaks of a speed profile.
fn units(speed: &[f64]) -> u32 {
    let least = LEAST_PEAK * speed.iter().copied().fold(0.0, f64::max);
    let (mut count, mut peak, mut valley, mut rising) = (0, 0.0f64, 0.0f64, true);
    for &now in speed {
        if rising {
            peak = peak.max(now);
            if now < VALLEY * peak && peak > least {
                (count, rising, valley) = (count + 1, false, now);
            }
        } else {
            valley = valley.min(now);
            if valley < VALLEY * now && now > least {
                (rising, peak) = (true, now);
            }
        }
    }
    count.max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peaks_are_counted_where_a_valley_lies_between_them() {
        let peak = |at: f64| (-(at * at)).exp();
        let speed = |apart: f64| -> Vec<f64> {
            (-500..500).map(|t| f64::from(t) / 100.0).map(|t| peak(t - apart) + peak(t + apart)).collect()
        };
        assert_eq!((units(&speed(0.2)), units(&speed(2.0))), (1, 2));
    }

    #[test]
    fn a_straight_movement_of_minimum_jerk_has_the_least_normalised_jerk() {
        let step = 1e-3;
        let place = |s: f64| Point3::new(0.3 * s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s), 0.0, 0.0);
        let places: Vec<_> = (0..=1000).map(|t| place(f64::from(t) * step)).collect();
        let speed = places.windows(2).map(|pair| (pair[1] - pair[0]).norm() / step).collect();
        let path = HandPath { places, step, speed };
        assert!((path.normalised_jerk() - 360f64.sqrt()).abs() < 0.1, "{}", path.normalised_jerk());
        assert_eq!(path.units(), 1);
    }
}
