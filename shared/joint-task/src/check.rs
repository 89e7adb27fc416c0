//! What is wrong with a task that can be read: subgoals that nobody can bring about, acts and words that mean two
//! things, decisions that are no decisions.

mod acts;
mod bringing;
mod finding;
mod margins;
mod parts;
mod phrases;
mod plan_state;
mod steady;
mod subject;

pub use finding::{Finding, FindingKind};

use crate::TaskError;
use std::path::Path;
use subject::Subject;

/// Everything that speaks against the task file at `path`, most basic first; nothing, when it is sound.
///
/// # Errors
/// A task or network file that cannot be read as one.
pub fn check(path: &Path) -> Result<Vec<Finding>, TaskError> {
    let subject = Subject::load(path)?;
    let kinds = [
        parts::missing(&subject),
        bringing::unreachable(&subject),
        acts::ambiguous(&subject),
        phrases::alike(&subject),
        margins::small(&subject),
    ];
    Ok(kinds.concat())
}
