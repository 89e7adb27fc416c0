use coact_joint_task::ActionType;
use coact_messages::MotionPhase;
use serde::Serialize;
use std::fmt;

/// What a run is doing when a fault strikes. It is recognised from the run itself, never from a clock.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Moment {
    /// The process was started, and the run's clock does not run yet.
    StartUp,
    /// The arm stands at its park posture.
    Idle,
    /// The arm moves.
    Moving,
    /// The robot's fingers close.
    Grasping,
    /// The robot gives a part to the person or takes one, and both hands are at it.
    HandingOver,
    /// The end of the run was requested.
    Shutdown,
}

/// What one sees of the robot from outside.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Sight {
    /// [`MotionPhase`] of the newest command.
    pub phase: Option<u32>,
    /// What the action under way does.
    pub action: Option<ActionType>,
    /// Speed of the fastest joint of the arm, measured, rad/s.
    pub speed: f64,
}

impl Moment {
    /// All moments in their order.
    pub const ALL: [Self; 6] =
        [Self::StartUp, Self::Idle, Self::Moving, Self::Grasping, Self::HandingOver, Self::Shutdown];

    /// An arm that is faster than this moves, rad/s: half of what most movements reach. Chosen by hand.
    const FAST: f64 = 0.3;
    /// One that is slower stands, rad/s: far above the encoders' scatter of 0.001. Chosen by hand.
    pub(crate) const STANDING: f64 = 0.02;

    /// The name that command line and reports use.
    pub fn name(self) -> &'static str {
        match self {
            Self::StartUp => "start-up",
            Self::Idle => "idle",
            Self::Moving => "moving",
            Self::Grasping => "grasping",
            Self::HandingOver => "handing-over",
            Self::Shutdown => "shutdown",
        }
    }

    /// Whether this is the moment; of start-up and shutdown nothing of the robot tells.
    pub(crate) fn is_at(self, sight: &Sight) -> bool {
        let phase = |wanted: &[MotionPhase]| wanted.iter().any(|wanted| sight.phase == Some(*wanted as u32));
        let hands_over = matches!(sight.action, Some(ActionType::Give | ActionType::Receive));
        match self {
            Self::StartUp | Self::Shutdown => false,
            Self::Idle => phase(&[MotionPhase::Rest]) && sight.speed < Self::STANDING,
            Self::Moving => sight.speed > Self::FAST,
            Self::Grasping => phase(&[MotionPhase::Grasp]),
            Self::HandingOver => hands_over && phase(&[MotionPhase::Dwell, MotionPhase::Release]),
        }
    }
}

impl fmt::Display for Moment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sight(phase: MotionPhase, action: Option<ActionType>, speed: f64) -> Sight {
        Sight { phase: Some(phase as u32), action, speed }
    }

    #[test]
    fn a_moment_is_recognised_by_what_the_robot_does() {
        assert!(Moment::Idle.is_at(&sight(MotionPhase::Rest, None, 0.001)));
        assert!(!Moment::Idle.is_at(&sight(MotionPhase::Rest, None, 0.5)));
        assert!(Moment::Moving.is_at(&sight(MotionPhase::Transport, None, 0.5)));
        assert!(Moment::Grasping.is_at(&sight(MotionPhase::Grasp, Some(ActionType::Insert), 0.0)));
        assert!(Moment::HandingOver.is_at(&sight(MotionPhase::Dwell, Some(ActionType::Give), 0.0)));
        assert!(!Moment::HandingOver.is_at(&sight(MotionPhase::Dwell, Some(ActionType::Steady), 0.0)));
        assert!(Moment::ALL.iter().all(|moment| !moment.is_at(&Sight::default())));
    }
}
