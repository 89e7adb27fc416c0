use coact_robot::MotionState;

/// How the waypoint between two segments is passed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Blend {
    /// With the velocity and acceleration for which the jerk of the whole movement is least.
    MinimumJerk,
    /// In the direction of the straight segment beside it, with this fraction of its mean speed; 0 is a stop.
    AlongStraight(f64),
    /// In these states, given as for a movement of 1 s.
    Given(Vec<[MotionState; 7]>),
}
