/// Why no movement was planned: the constraint that binds. Lengths m, angles rad.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// The arm would have to start where it touches something.
    #[error("the arm starts {:.0} mm inside its distance: {link} is too near to {other}; move one of them away", 1e3 * .short)]
    Start {
        /// Link.
        link: String,
        /// What it is too near to.
        other: String,
        /// By how much.
        short: f64,
    },
    /// No posture reaches the goal, whatever the joint limits.
    #[error("the goal at ({:.3}, {:.3}, {:.3}) m is out of the arm's reach from this side", .point[0], .point[1], .point[2])]
    OutOfReach {
        /// Place of the grasp point.
        point: [f64; 3],
    },
    /// Postures reach the goal, but all of them break a joint limit.
    #[error(
        "every posture at the goal breaks a joint limit: joint \"{joint}\" would have to go {excess:.2} rad beyond its own"
    )]
    JointLimit {
        /// The joint of the posture that breaks the limits least.
        joint: String,
        /// By how much.
        excess: f64,
    },
    /// Postures reach the goal within the limits, but all of them touch something.
    #[error("every posture at the goal touches something: {link} would be {:.0} mm too near to {other}", 1e3 * .short)]
    Blocked {
        /// Link, in the posture that would come least too near.
        link: String,
        /// What it would be too near to.
        other: String,
        /// By how much.
        short: f64,
    },
    /// The goal can be reached, but no path to it was found.
    #[error("no path to the goal was found: {:.0} % along the best one, {link} would be {:.0} mm too near to {other}", 100.0 * .fraction, 1e3 * .short)]
    NoPath {
        /// Link.
        link: String,
        /// What it would be too near to.
        other: String,
        /// By how much.
        short: f64,
        /// Where on the path, as the fraction of the reach's duration.
        fraction: f64,
    },
    /// The arm moves so that it cannot come to the goal without breaking a limit: it must brake first.
    #[error(
        "the arm moves too fast to go there without braking first: joint \"{joint}\" would break a limit"
    )]
    TooFast {
        /// The joint.
        joint: String,
    },
}
