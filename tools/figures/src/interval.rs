/// A time in which the person does one thing.
#[derive(Debug, Clone, PartialEq)]
pub struct Interval {
    /// The chapter's name of the instant at which it begins: T1, T2, ...
    pub name: String,
    /// What the person does.
    pub doing: String,
    /// Begin, ms from the start of the run.
    pub from_ms: f64,
    /// End, ms.
    pub to_ms: f64,
}
