use bytemuck::{Pod, Zeroable};

/// An index that may be absent, in a form that state words can hold.
#[repr(transparent)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Slot(u64);

impl Slot {
    /// No index.
    pub const EMPTY: Self = Self(0);

    /// This index.
    pub fn of(index: usize) -> Self {
        Self(index as u64 + 1)
    }

    /// The index, if there is one.
    pub fn get(self) -> Option<usize> {
        self.0.checked_sub(1).map(|index| index as usize)
    }

    /// The index as messages hold it.
    pub fn message(self) -> u32 {
        self.get().map_or(coact_messages::NONE, |index| index as u32)
    }
}
