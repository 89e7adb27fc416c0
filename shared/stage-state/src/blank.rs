use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};

/// A word without a meaning: zero. It fills up the shorter variants of an enum with fields.
#[repr(u64)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, CheckedBitPattern, NoUninit, Zeroable)]
pub enum Blank {
    /// The only value.
    #[default]
    Zero = 0,
}
