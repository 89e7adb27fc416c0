/// A learned connection from an observed act to a chain of the person.
#[derive(Debug, Clone, PartialEq)]
pub struct Connection {
    /// Label of the act in AOL.
    pub act: String,
    /// Label of the chain in ASL.
    pub chain: String,
    /// Strength, in units of the ignition threshold.
    pub weight: f64,
    /// Successes of that chain; 0 when it was carried over from other kinds of part.
    pub successes: u32,
}
