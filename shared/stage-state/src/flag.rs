use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};

/// A truth value as a word.
#[repr(u64)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, CheckedBitPattern, NoUninit, Zeroable)]
pub enum Flag {
    /// False.
    #[default]
    Unset = 0,
    /// True.
    Set = 1,
}

impl Flag {
    /// Whether it is true.
    pub fn is_set(self) -> bool {
        self == Self::Set
    }
}

impl From<bool> for Flag {
    fn from(value: bool) -> Self {
        if value { Self::Set } else { Self::Unset }
    }
}
