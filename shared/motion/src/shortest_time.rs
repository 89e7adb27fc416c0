use coact_robot::{JointLimits, MotionState, Posture};

/// The shortest time in which all joints could come to these positions and rest there, each by itself, whatever is in the way, s; of joints
/// under way a little less than that.
pub fn shortest_time(from: &[MotionState; 7], to: &Posture, limits: &[JointLimits; 7]) -> f64 {
    let times = from.iter().zip(to).zip(limits).map(|((from, to), limits)| {
        let way = (to - from.position).abs();
        if from.is_at_rest() { rest_to_rest(way, limits) } else { way / limits.velocity }
    });
    times.fold(0.0, f64::max)
}

/// The time-optimal movement of limited jerk (Biagiotti, Melchiorri, *Trajectory Planning for Automatic Machines and Robots*, ch. 3.4):
/// speed and acceleration reach their limits, or the acceleration alone, or the speed alone, or neither.
fn rest_to_rest(way: f64, limits: &JointLimits) -> f64 {
    let JointLimits { velocity, acceleration, jerk, .. } = *limits;
    let rise = acceleration / jerk;
    if acceleration * rise > velocity {
        let rise = (velocity / jerk).sqrt();
        return if way >= 2.0 * velocity * rise {
            way / velocity + 2.0 * rise
        } else {
            4.0 * (way / (2.0 * jerk)).cbrt()
        };
    }
    if way >= velocity * (velocity / acceleration + rise) {
        way / velocity + velocity / acceleration + rise
    } else if way >= 2.0 * acceleration * rise.powi(2) {
        rise + (rise.powi(2) + 4.0 * way / acceleration).sqrt()
    } else {
        4.0 * (way / (2.0 * jerk)).cbrt()
    }
}
