use super::ArmTrajectory;
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_robot::{MotionState, Posture};
use coact_stage_state::{Flag, Implausible, ensure, finite};

/// How the arm moves.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct ArmState {
    /// The trajectory under way.
    pub trajectory: ArmTrajectory,
    /// How far it has come: time of the trajectory, s.
    pub elapsed: f64,
    /// Speed override: fraction of its planned speed at which it goes on.
    pub speed_override: f64,
    /// Change of that, 1/s.
    pub override_rate: f64,
    /// Whether the arm brakes: a trajectory begins anew, from rest, when it stands.
    pub braking: Flag,
    /// How far the hand was in a narrow place when the arm last braked to a stand: fraction of the way into it.
    enclosed: f64,
    /// Cycles for which the person has been in the way.
    pub blocked: u64,
}

impl ArmState {
    /// Standing still.
    pub fn at_rest(posture: Posture) -> Self {
        Self { trajectory: ArmTrajectory::resting(posture), speed_override: 1.0, ..Self::zeroed() }
    }

    /// Puts a trajectory under way.
    pub fn follow(&mut self, trajectory: &ArmTrajectory) {
        self.trajectory = *trajectory;
        (self.elapsed, self.speed_override, self.override_rate) = (0.0, 1.0, 0.0);
        self.braking = Flag::Unset;
    }

    /// Ends the trajectory where the arm has come to a stand.
    pub fn rest(&mut self, posture: Posture) {
        self.enclosed = self.enclosed();
        self.follow(&ArmTrajectory::resting(posture));
    }

    /// State of the arm `ahead` s from now, at the trajectory's planned speed.
    pub fn ahead(&self, ahead: f64) -> [MotionState; 7] {
        self.trajectory.at(self.elapsed + ahead)
    }

    /// Whether the arm is at the end of the trajectory.
    pub fn is_at_end(&self) -> bool {
        !self.braking.is_set() && self.elapsed >= self.trajectory.duration()
    }

    /// Whether the trajectory goes on at its planned speed.
    pub fn is_at_planned_speed(&self) -> bool {
        !self.braking.is_set() && self.speed_override == 1.0 && self.override_rate == 0.0
    }

    /// Whether the hand goes straight to its goal, or is there.
    pub fn is_approaching(&self) -> bool {
        self.trajectory.is_approach(self.elapsed)
    }

    /// How far the hand is in a narrow place, as a fraction of the way into it.
    pub fn enclosed(&self) -> f64 {
        if self.trajectory.duration() > 0.0 { self.trajectory.enclosed(self.elapsed) } else { self.enclosed }
    }

    pub fn check(&self) -> Result<(), Implausible> {
        self.trajectory.check("arm.trajectory")?;
        ensure(self.elapsed >= 0.0, "arm.elapsed", "a time from 0 s on")?;
        ensure((0.0..=1.0).contains(&self.speed_override), "arm.speed_override", "a fraction")?;
        finite("arm.override_rate, arm.enclosed", &[self.override_rate, self.enclosed])
    }
}
