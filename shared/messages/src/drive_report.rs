use crate::JOINTS;
use bytemuck::{CheckedBitPattern, NoUninit, Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// What the drive, the side that moves the joints, does with the commands: its own setpoints, and how it came to them.
///
/// Control goes on from here when the drive has not followed its last command.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
pub struct DriveReport {
    /// Position setpoints of all joints, rad.
    pub position: [f64; JOINTS],
    /// Their first difference, rad/s.
    pub velocity: [f64; JOINTS],
    /// Their second difference, rad/s².
    pub acceleration: [f64; JOINTS],
    /// How far the arm has come on the path of the command it follows: time of the path, s.
    pub elapsed: f64,
    /// Fraction of the planned speed at which it goes on along that path.
    pub speed_override: f64,
    /// Change of that, 1/s.
    pub override_rate: f64,
    /// 1 while the arm's setpoints lie on that path.
    pub on_path: u32,
    /// [`DriveMode`].
    pub mode: u32,
    /// [`HoldReason`].
    pub hold: u32,
    /// Reserved, zero.
    pub reserved: u32,
    /// Cycle of the last command that was followed.
    pub command_cycle: u64,
    /// Commands that were refused so far, by [`CommandRefusal`].
    pub refused: [u64; CommandRefusal::COUNT],
}

/// What a drive does.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, CheckedBitPattern, NoUninit, Zeroable)]
pub enum DriveMode {
    /// No joints are driven: a recording is played.
    Absent = 0,
    /// Nothing is commanded, and the joints stand.
    Standing = 1,
    /// The setpoints are those of the newest command.
    Following = 2,
    /// No good command came for a cycle or two: the joints go on as they move.
    Bridging = 3,
    /// The joints brake within their limits.
    Braking = 4,
}

/// Why a drive follows no command, however good.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, CheckedBitPattern, NoUninit, Zeroable)]
pub enum HoldReason {
    /// It follows commands.
    None = 0,
    /// The joints were not where their setpoints are: it brakes, and starts again from where they are.
    TrackingError = 1,
    /// Nobody says that the robot may move, or somebody says that it may not.
    Stopped = 2,
    /// The process ends.
    Ending = 3,
}

/// Why a drive does not follow a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(usize)]
pub enum CommandRefusal {
    /// It has another message layout.
    Layout = 0,
    /// A number is none, or infinite.
    NotFinite = 1,
    /// It does not come after the last one in sequence and cycle: repeated, backward, or from another writer.
    OutOfOrder = 2,
    /// Its cycle is too long ago.
    Old = 3,
    /// Its cycle is more than one ahead.
    Ahead = 4,
    /// A joint could not do it within its limits, from where it is.
    BeyondLimits = 5,
    /// The drive holds the joints ([`HoldReason`]).
    Held = 6,
}

impl CommandRefusal {
    /// How many reasons there are.
    pub const COUNT: usize = 7;

    /// All of them, in the order of [`DriveReport::refused`].
    pub const ALL: [Self; Self::COUNT] = [
        Self::Layout,
        Self::NotFinite,
        Self::OutOfOrder,
        Self::Old,
        Self::Ahead,
        Self::BeyondLimits,
        Self::Held,
    ];
}
