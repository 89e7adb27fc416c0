use crate::segment::{self, Segment};
use crate::{Mechanism, Plan};
use coact_robot::MotionState;

/// The path of hand and joints through segments, measured at equal steps of the segments' own time.
pub(crate) struct MeasuredPath<'a> {
    pub segments: &'a [Segment],
    /// Time between two points, s.
    pub step: f64,
    /// Speeds at the points: of the hand, m/s, and of all joints together, rad/s.
    pub speeds: Vec<(f64, f64)>,
}

/// Steps in which a path is measured. A trade-off with the time of planning; many times as many as a plan has knots.
pub(crate) const MEASURED: usize = 240;
const _: () = assert!(MEASURED > 4 * Plan::KNOTS);

impl<'a> MeasuredPath<'a> {
    pub fn of(mechanism: &Mechanism, segments: &'a [Segment]) -> Self {
        let step = segment::duration(segments) / MEASURED as f64;
        let hand = |t: f64| {
            mechanism.arm.palm(&segment::states_at(segments, t).map(|state| state.position))
                * mechanism.grasp_point()
        };
        let places: Vec<_> = (0..=2 * MEASURED).map(|half| hand(0.5 * step * half as f64)).collect();
        let speeds = (0..=MEASURED).map(|point| {
            let (before, after) = ((2 * point).max(1) - 1, (2 * point + 1).min(2 * MEASURED));
            let hand = (places[after] - places[before]).norm() / (0.5 * step * (after - before) as f64);
            let joints = segment::states_at(segments, point as f64 * step)
                .map(|state: MotionState| state.velocity.powi(2));
            (hand, joints.iter().sum::<f64>().sqrt())
        });
        Self { segments, step, speeds: speeds.collect() }
    }
}
