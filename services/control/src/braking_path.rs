use crate::state::ArmTrajectory;
use coact_period::PERIOD_S;
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
    const MOST: usize = 13;

    /// The braking from here; none when the arm does not stand within the time that there is room for. Its first step is one cycle:
    /// it tells how fast the arm is now, which from point to point of the braking becomes slower.
    pub fn from(
        mut progress: PathProgress,
        trajectory: &ArmTrajectory,
        limits: &[JointLimits; 7],
    ) -> Option<Self> {
        let point = |ahead: f64, at: f64| BrakingPoint { ahead, at, posture: trajectory.posture(at) };
        let mut path = Self { points: [point(0.0, progress.elapsed); Self::MOST], count: 1 };
        let mut ahead = 0.0;
        for step in 0..=KEPT * (Self::MOST - 2) {
            let dt = if step == 0 { PERIOD_S } else { STEP };
            progress = progress.towards(0.0, trajectory.knots(), limits, 1.0, dt);
            ahead += dt;
            let stands = progress.stands();
            if stands || step.is_multiple_of(KEPT) {
                path.points[path.count] = point(ahead, progress.elapsed);
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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use coact_motion::Plan;
    use coact_robot::{Knot, MotionState, Robot};
    use std::path::Path;

    #[test]
    fn its_first_step_tells_how_fast_the_arm_is_now_and_its_end_where_it_stands() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/robots/aros.toml");
        let robot = Robot::load(&file).unwrap();
        let limits = std::array::from_fn(|joint| robot.limits()[joint]);
        // Each joint turns by half a radian in a second.
        let knot = |t: f64, turn: f64| Knot {
            t,
            states: robot.park.map(|angle| MotionState::at_rest(angle + turn)),
        };
        let knots = vec![knot(0.0, 0.0), knot(1.0, 0.5)];
        let plan = Plan { knots, ..Plan::default() };
        let trajectory = ArmTrajectory::of(&plan).unwrap();
        let progress = PathProgress { elapsed: 0.5, ..PathProgress::START };
        let path = BrakingPath::from(progress, &trajectory, &limits).unwrap();
        let [now, next, ..] = path.points() else { panic!("{path:?}") };
        let speed = (next.posture[0] - now.posture[0]) / next.ahead;
        let planned = trajectory.at(0.5)[0].velocity;
        assert!((0.99 * planned..planned).contains(&speed), "{speed} rad/s of {planned}");
        let last = path.points().last().unwrap();
        assert!((0.03..0.2).contains(&last.ahead) && last.at > 0.5 + 0.2 * last.ahead, "{last:?}");
    }
}
