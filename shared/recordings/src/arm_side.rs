/// Which of a person's arms.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ArmSide {
    /// The left one.
    Left,
    /// The right one.
    Right,
}

impl ArmSide {
    /// Both.
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// As columns and partners name it: `left`, `right`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }
}
