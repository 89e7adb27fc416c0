use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_messages::PartnerPhase;

/// Phase of the person's activity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, CheckedBitPattern, NoUninit, Zeroable)]
#[repr(u64)]
pub enum ActivityPhase {
    /// The hand lies at rest.
    Rest = 0,
    /// Under way, but not yet so fast that an observer would speak of a reach.
    Prepare = 1,
    /// From reach onset until the fingers close.
    Reach = 2,
    /// Fingers closed, part not yet lifted.
    Dwell = 3,
    /// The part is carried to where it is wanted.
    Carry = 4,
    /// At the socket, until the robot steadies the base.
    AwaitSteadying = 5,
    /// At the socket: the part is being mounted.
    Mount = 6,
    /// The part is shown to the robot, for it to take.
    Give = 7,
    /// The part is carried to where it is laid down: where it lay, or, one that was mounted, to a free place.
    Return = 8,
    /// The gesture is shown.
    Show = 9,
    /// Fingers on a part that the robot has not let go yet.
    AwaitRelease = 10,
    /// The empty hand goes back to rest.
    Withdraw = 11,
    /// The part is held ready over where it lay, until its step's turn has come.
    AwaitTurn = 12,
}

impl ActivityPhase {
    /// What the monitor is told.
    pub fn as_told(self) -> PartnerPhase {
        match self {
            Self::Rest | Self::Prepare => PartnerPhase::Idle,
            Self::Reach => PartnerPhase::Reach,
            Self::Dwell | Self::Carry | Self::Return => PartnerPhase::Transport,
            Self::AwaitTurn
            | Self::AwaitSteadying
            | Self::Mount
            | Self::Give
            | Self::Show
            | Self::AwaitRelease => PartnerPhase::Act,
            Self::Withdraw => PartnerPhase::Withdraw,
        }
    }
}
