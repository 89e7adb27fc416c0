//! What is wrong with a task that can be read: subgoals that nobody can bring about, acts and words that mean two
//! things, decisions that are no decisions.

mod ambiguous_chains;
mod ambiguous_phrases;
mod examined_task;
mod finding;
mod missing_parts;
mod plan_state;
mod small_margins;
mod steady_state;
mod unreachable_subgoals;

pub use finding::{Finding, FindingKind};

use crate::TaskError;
use examined_task::ExaminedTask;
use std::path::Path;

/// Everything that speaks against the task file at `path`, most basic first; nothing, when it is sound.
///
/// # Errors
/// A task or network file that cannot be read as one.
pub fn check(path: &Path) -> Result<Vec<Finding>, TaskError> {
    let task = ExaminedTask::load(path)?;
    let kinds = [
        missing_parts::find(&task),
        unreachable_subgoals::find(&task),
        ambiguous_chains::find(&task),
        ambiguous_phrases::find(&task),
        small_margins::find(&task),
    ];
    Ok(kinds.concat())
}
