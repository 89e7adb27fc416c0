use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};

/// Which of a person's arms: index into what there is one of for each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, CheckedBitPattern, NoUninit, Zeroable)]
#[repr(u32)]
pub enum ArmSide {
    /// The right one.
    Right = 0,
    /// The left one.
    Left = 1,
}

impl ArmSide {
    /// Both.
    pub const BOTH: [Self; 2] = [Self::Right, Self::Left];

    /// The other one.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Right => Self::Left,
            Self::Left => Self::Right,
        }
    }

    /// As columns and partners name it: `right`, `left`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Left => "left",
        }
    }
}
