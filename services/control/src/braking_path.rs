use crate::state::ArmTrajectory;
use coact_robot::{JointLimits, PathProgress, Posture};

/// Where the arm is until it stands, if it brakes along its trajectory as hard as the joints can.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BrakingPath {
    points: [BrakingPoint; Self::MOST],
    count: usize,
}

/// One point of it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BrakingPoint {
    /// Time from now, s.
    pub ahead: f64,
    /// Time of the trajectory, s.
    pub at: f64,
    pub posture: Posture,
}

/// Time from point to point of the braking that is computed, s. A trade-off: shorter steps cost more, longer ones see the
/// stop a little nearer than it is; the hand moves by 6 mm in one at 1 m/s.
const STEP: f64 = 0.006;
/// Steps of which one is kept. A trade-off likewise: distances change by less than 40 mm between two of them, and braking
/// is a smooth movement.
const KEPT: usize = 6;

impl BrakingPath {
    /// Most points: of 0.4 s, twice what the shipped arm needs from its full speed.
    const MOST: usize = 12;

    /// The braking from here; none when the arm does not stand within the time that there is room for.
    pub fn from(
        mut progress: PathProgress,
        trajectory: &ArmTrajectory,
        limits: &[JointLimits; 7],
    ) -> Option<Self> {
        let point = |ahead: f64, at: f64| BrakingPoint { ahead, at, posture: trajectory.posture(at) };
        let mut path = Self { points: [point(0.0, progress.elapsed); Self::MOST], count: 1 };
        for step in 1..=KEPT * (Self::MOST - 1) {
            progress = progress.towards(0.0, trajectory.knots(), limits, 1.0, STEP);
            let stands = progress.stands();
            if stands || step.is_multiple_of(KEPT) {
                path.points[path.count] = point(STEP * step as f64, progress.elapsed);
                path.count += 1;
            }
            if stands {
                return Some(path);
            }
        }
        None
    }

    /// Its points, from now until the arm stands.
    pub fn points(&self) -> &[BrakingPoint] {
        &self.points[..self.count]
    }
}
