/// A reader of bytes that nobody vouches for.
#[derive(Debug, Clone, Copy)]
pub struct Target {
    /// Its name; also that of its folder below `corpus`.
    pub name: &'static str,
    /// What its bytes are, so that changes of them get past the first look.
    pub input: Input,
    /// Files that the project ships and that it takes in, from the root of the checkout; a `*` stands for any name.
    pub seeds: &'static [&'static str],
    /// Reads the bytes, and uses what they hold: says whether they were taken in.
    pub run: fn(&[u8]) -> bool,
}

/// What the bytes of a target are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Input {
    /// Lines of words and numbers.
    Text,
    /// Bytes.
    Bytes,
    /// Changes of a good message: see `patch.rs`.
    Patch,
}
