use super::ArmTrajectory;
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_robot::{MotionState, PathProgress, Posture};
use coact_stage_state::{Flag, Implausible, ensure, finite};

/// How the arm moves.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct ArmState {
    /// The trajectory under way.
    pub trajectory: ArmTrajectory,
    /// How far it has come on it, and how fast it goes on.
    pub progress: PathProgress,
    /// Whether the arm brakes: a trajectory begins anew, from rest, when it stands.
    pub braking: Flag,
    /// How far the hand was in a narrow place when the arm last came to rest on its way: fraction of the way into it.
    enclosed: f64,
    /// The fastest speed override that the guard admits, 0 to 1.
    pub fastest: f64,
    /// Cycles for which the person has been in the way.
    pub blocked: u64,
}

impl ArmState {
    /// Standing still.
    pub fn at_rest(posture: Posture) -> Self {
        Self {
            trajectory: ArmTrajectory::resting(posture),
            progress: PathProgress::START,
            fastest: 1.0,
            ..Self::zeroed()
        }
    }

    /// Puts a trajectory under way: one from rest at the speed that the guard admits.
    pub fn follow(&mut self, trajectory: &ArmTrajectory) {
        self.trajectory = *trajectory;
        self.progress = PathProgress::START;
        if trajectory.begins_at_rest() {
            self.progress.speed_override = self.fastest;
        }
        self.braking = Flag::Unset;
    }

    /// Ends the trajectory where the arm has come to a stand.
    pub fn rest(&mut self, posture: Posture) {
        self.enclosed = self.enclosed();
        self.follow(&ArmTrajectory::resting(posture));
    }

    /// The same where the person's hand has come to meet the robot's: however short of its goal that is, it leads out of her hand.
    pub fn rest_in_hand(&mut self, posture: Posture) {
        self.rest(posture);
        self.enclosed = 1.0;
    }

    /// State of the arm `ahead` s from now, at the trajectory's planned speed.
    pub fn ahead(&self, ahead: f64) -> [MotionState; 7] {
        self.trajectory.at(self.progress.elapsed + ahead)
    }

    /// Whether the arm is at the end of the trajectory.
    pub fn is_at_end(&self) -> bool {
        !self.braking.is_set() && self.progress.elapsed >= self.trajectory.duration()
    }

    /// Whether it becomes slower, along its trajectory or joint by joint.
    pub fn brakes(&self) -> bool {
        self.braking.is_set() || self.progress.override_rate < 0.0
    }

    /// Whether the trajectory goes on at its planned speed.
    pub fn is_at_planned_speed(&self) -> bool {
        !self.braking.is_set() && self.progress.is_at_planned_speed()
    }

    /// Whether the hand goes straight to its goal, or is there.
    pub fn is_approaching(&self) -> bool {
        self.trajectory.is_approach(self.progress.elapsed)
    }

    /// How far the hand is in a narrow place, as a fraction of the way into it.
    pub fn enclosed(&self) -> f64 {
        if self.trajectory.duration() > 0.0 {
            self.trajectory.enclosed(self.progress.elapsed)
        } else {
            self.enclosed
        }
    }

    pub fn check(&self) -> Result<(), Implausible> {
        self.trajectory.check("arm.trajectory")?;
        let PathProgress { elapsed, speed_override, override_rate } = self.progress;
        ensure(elapsed >= 0.0, "arm.progress.elapsed", "a time from 0 s on")?;
        ensure((0.0..=1.0).contains(&speed_override), "arm.progress.speed_override", "a fraction")?;
        finite("arm.progress.override_rate", &[override_rate])?;
        ensure((0.0..=1.0).contains(&self.fastest), "arm.fastest", "a fraction")?;
        finite("arm.enclosed", &[self.enclosed])
    }
}
