use coact_messages::MAX_KINDS;

/// Why there is no task of such a shape.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ShapeError {
    /// Too few subgoals, or more than the table holds.
    #[error("{found} subgoals; expected {least} to {most}")]
    Subgoals {
        /// What was asked for.
        found: usize,
        /// At least.
        least: usize,
        /// At most.
        most: usize,
    },
    /// No subgoal can come after so many.
    #[error("{found} predecessors; expected 1 to {most}, and fewer than subgoals")]
    Predecessors {
        /// What was asked for.
        found: usize,
        /// At most.
        most: usize,
    },
    /// No fraction.
    #[error("a share of {found} {of}; expected 0 to 1")]
    Share {
        /// What was asked for.
        found: f64,
        /// Which steps it is the share of.
        of: &'static str,
    },
    /// More kinds than a task can have.
    #[error(
        "{found} kinds of parts, and {MAX_KINDS} at most are possible; ask for fewer subgoals, or a greater share with identical parts"
    )]
    Kinds {
        /// How many there would be.
        found: usize,
    },
}
