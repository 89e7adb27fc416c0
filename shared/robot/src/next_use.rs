/// What is done next with something that is gripped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NextUse {
    /// Nothing that asks for a grip of its own.
    Anything,
    /// Its underside goes into something.
    Insert {
        /// How deep, m.
        depth: f64,
    },
    /// A person takes it.
    HandOver {
        /// Height of the part that the person needs for the own fingers, m.
        room: f64,
    },
}
