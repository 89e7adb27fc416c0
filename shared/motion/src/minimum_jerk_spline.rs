//! Minimum-jerk movements through waypoints (Flash, Hogan, J. Neurosci. 5, 1985): pieces of fifth degree whose jerk and
//! snap are continuous at the waypoints, too.

use coact_robot::MotionState;
use nalgebra::{DMatrix, DVector};

/// Velocity and acceleration of one joint at the waypoints between `start` and the end, at rest in the last of
/// `positions`, for which the integral of the squared jerk is least. `positions`: at the end of each piece, rad;
/// `times`: duration of each piece, s. None where the system of equations is singular.
pub(crate) fn derivatives(start: &MotionState, positions: &[f64], times: &[f64]) -> Option<Vec<[f64; 2]>> {
    let count = positions.len() - 1;
    let mut system = System::new(count);
    for waypoint in 0..count {
        system.add_continuity(waypoint, start, positions, times);
    }
    let solution = system.matrix.lu().solve(&system.right)?;
    Some((0..count).map(|waypoint| [solution[2 * waypoint], solution[2 * waypoint + 1]]).collect())
}

/// Linear equations for velocity (2 i) and acceleration (2 i + 1) at waypoint i.
struct System {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    count: usize,
}

/// A term of an equation: an unknown by its index, or a known value.
#[derive(Clone, Copy)]
enum Term {
    Unknown(usize),
    Known(f64),
}

impl System {
    fn new(count: usize) -> Self {
        Self { matrix: DMatrix::zeros(2 * count, 2 * count), right: DVector::zeros(2 * count), count }
    }

    /// Jerk and snap are the same on both sides of a waypoint. The factors are those of a polynomial of fifth degree at
    /// its ends, by its boundary values.
    fn add_continuity(&mut self, waypoint: usize, start: &MotionState, positions: &[f64], times: &[f64]) {
        let before = waypoint.checked_sub(1).map_or(start.position, |before| positions[before]);
        let (t, u) = (times[waypoint], times[waypoint + 1]);
        let (d, e) = (positions[waypoint] - before, positions[waypoint + 1] - positions[waypoint]);
        let (jerk, snap) = (2 * waypoint, 2 * waypoint + 1);
        let [v0, a0] = match waypoint.checked_sub(1) {
            Some(last) => [Term::Unknown(2 * last), Term::Unknown(2 * last + 1)],
            None => [Term::Known(start.velocity), Term::Known(start.acceleration)],
        };
        let [v1, a1] = [Term::Unknown(2 * waypoint), Term::Unknown(2 * waypoint + 1)];
        let [v2, a2] = if waypoint + 1 < self.count {
            [Term::Unknown(2 * waypoint + 2), Term::Unknown(2 * waypoint + 3)]
        } else {
            [Term::Known(0.0), Term::Known(0.0)]
        };
        self.add(jerk, Term::Known(1.0), 60.0 * d / t.powi(3) - 60.0 * e / u.powi(3));
        self.add(jerk, v0, -24.0 / t.powi(2));
        self.add(jerk, a0, -3.0 / t);
        self.add(jerk, v1, -36.0 / t.powi(2) + 36.0 / u.powi(2));
        self.add(jerk, a1, 9.0 / t + 9.0 / u);
        self.add(jerk, v2, 24.0 / u.powi(2));
        self.add(jerk, a2, -3.0 / u);
        self.add(snap, Term::Known(1.0), 360.0 * d / t.powi(4) + 360.0 * e / u.powi(4));
        self.add(snap, v0, -168.0 / t.powi(3));
        self.add(snap, a0, -24.0 / t.powi(2));
        self.add(snap, v1, -192.0 / t.powi(3) - 192.0 / u.powi(3));
        self.add(snap, a1, 36.0 / t.powi(2) - 36.0 / u.powi(2));
        self.add(snap, v2, -168.0 / u.powi(3));
        self.add(snap, a2, 24.0 / u.powi(2));
    }

    /// Adds `factor` times a term to an equation whose sum is zero.
    fn add(&mut self, row: usize, term: Term, factor: f64) {
        match term {
            Term::Unknown(column) => self.matrix[(row, column)] += factor,
            Term::Known(value) => self.right[row] -= factor * value,
        }
    }
}
