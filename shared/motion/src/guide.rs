use crate::{Mechanism, Stage, StageKind};
use nalgebra::{Matrix3, Point3, Vector3};

/// The line on which the hand comes to its goal where what it holds goes into something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Guide {
    /// Its end: the goal of the grasp point, m.
    end: Point3<f64>,
    /// Direction of the hand on it, unit.
    line: Vector3<f64>,
    /// Its length, m.
    length: f64,
}

/// How far the hand may be off its line at the goal, m, and how much more for each metre before it.
const OFF_LINE: (f64, f64) = (0.002, 0.1);

impl Guide {
    /// To the end of these stages, along `line`, m; none for a line without length, or where no approach ends.
    pub fn to_end_of(mechanism: &Mechanism, stages: &[Stage], line: Vector3<f64>) -> Option<Self> {
        let length = line.norm();
        let last = stages.last().filter(|last| length > 0.0 && last.kind == StageKind::Approach)?;
        let palm = mechanism.arm.palm(&last.trajectory.posture(1.0));
        Some(Self { end: palm * mechanism.grasp_point(), line: line / length, length })
    }

    /// How far a place of the grasp point is off the line, m, world; none before the line begins.
    pub fn aside(&self, place: &Point3<f64>) -> Option<Vector3<f64>> {
        let way = place - self.end;
        (self.before(place) < self.length).then(|| self.across() * way)
    }

    /// What of a vector is across the line.
    pub fn across(&self) -> Matrix3<f64> {
        Matrix3::identity() - self.line * self.line.transpose()
    }

    /// By how much it is farther off than it may be, m.
    pub fn excess(&self, place: &Point3<f64>) -> f64 {
        let allowed = OFF_LINE.0 + OFF_LINE.1 * self.before(place).max(0.0);
        self.aside(place).map_or(0.0, |aside| (aside.norm() - allowed).max(0.0))
    }

    /// Distance before the goal, m.
    fn before(&self, place: &Point3<f64>) -> f64 {
        -(place - self.end).dot(&self.line)
    }
}
