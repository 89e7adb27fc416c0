use crate::followed_command::FollowedCommand;
use crate::followed_path::FollowedPath;
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_messages::{CommandRefusal, DriveMode, HoldReason, JOINTS};
use coact_robot::MotionState;
use coact_stage_state::{Flag, Implausible, finite};

/// All that a drive keeps from cycle to cycle: it goes on from here after a restart.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub struct DriveState {
    pub(crate) setpoints: [MotionState; JOINTS],
    pub(crate) path: FollowedPath,
    pub(crate) last: FollowedCommand,
    /// Generation of the command that was judged last, and one more than its sequence: each is judged once.
    pub(crate) judged: [u64; 2],
    /// Tick of the last step.
    pub(crate) tick: u64,
    /// Cycles without a command that was followed.
    pub(crate) silent: u64,
    /// Cycles since then that the driver itself has missed.
    pub(crate) late: u64,
    /// Cycles for which the arm has been too far from its setpoints.
    pub(crate) deviating: u64,
    /// Positions of the arm's joints when they were measured last, rad.
    pub(crate) measured: [f64; JOINTS],
    pub(crate) refused: [u64; CommandRefusal::COUNT],
    pub(crate) mode: DriveMode,
    pub(crate) hold: HoldReason,
    /// Whether the arm must start again from where it is.
    pub(crate) lost: Flag,
}

impl DriveState {
    /// Refuses what no drive can have come to.
    ///
    /// # Errors
    /// The first such field.
    pub fn check(&self) -> Result<(), Implausible> {
        finite("drive.setpoints", bytemuck::cast_slice(&self.setpoints))?;
        self.path.check()
    }
}
