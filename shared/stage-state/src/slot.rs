use bytemuck::{Pod, Zeroable};

/// An index that may be absent, as a word.
#[repr(transparent)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Slot(u64);

impl Slot {
    /// No index.
    pub const EMPTY: Self = Self(0);

    /// This index.
    pub const fn of(index: usize) -> Self {
        Self(index as u64 + 1)
    }

    /// The index, if there is one.
    pub fn get(self) -> Option<usize> {
        self.0.checked_sub(1).map(|index| index as usize)
    }

    /// The index as messages hold it, or `none`, their word for an absent one.
    pub fn or(self, none: u32) -> u32 {
        self.get().map_or(none, |index| index as u32)
    }

    /// Whether there is no index, or one of `count` things.
    pub fn is_below(self, count: usize) -> bool {
        self.0 <= count as u64
    }
}

impl From<Option<usize>> for Slot {
    fn from(index: Option<usize>) -> Self {
        index.map_or(Self::EMPTY, Self::of)
    }
}
