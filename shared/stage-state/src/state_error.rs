/// Why words are not taken for a stage's state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum StateError {
    /// The mark is another one.
    #[error(
        "the words hold no state of {stage}, layout {layout}: the first is {found:#018x}, expected {expected:#018x}; \
         they come from another stage or another version, start without them"
    )]
    Mark {
        /// Whose state was expected.
        stage: &'static str,
        /// Number of the layout that was expected.
        layout: u32,
        /// The first word.
        found: u64,
        /// What it should be.
        expected: u64,
    },
    /// A word is no value of its enum or flag.
    #[error(
        "word {word} of the state of {stage} is {found:#018x}, which is no value of its type; expected one of the few \
         that an enum or a flag has; the message is damaged, start without it"
    )]
    NoValue {
        /// Whose state it is.
        stage: &'static str,
        /// Index among the words of the message.
        word: usize,
        /// What stands there.
        found: u64,
    },
    /// The checksum is another one.
    #[error("the checksum of the state of {stage} is wrong; the message is damaged, start without it")]
    Checksum {
        /// Whose state it is.
        stage: &'static str,
    },
    /// A field is not what it can be.
    #[error("the state of {stage} is refused: {reason}; the message is damaged, start without it")]
    Implausible {
        /// Whose state it is.
        stage: &'static str,
        /// The field.
        reason: Implausible,
    },
}

/// A field of a state that is not what it can be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{field} is implausible, expected {expected}")]
pub struct Implausible {
    /// Its name, with the names of the structs around it.
    pub field: &'static str,
    /// What was expected.
    pub expected: &'static str,
}
