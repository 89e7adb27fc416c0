//! Process sets that are running now.

use anyhow::{Context, Result, bail, ensure};
use coact_pipeline::{Run, RunError};

/// The run of this name, or, without one, the only one.
///
/// # Errors
/// There is no such run, or there are several.
pub fn only(id: Option<&str>) -> Result<Run> {
    let mut living = all();
    if let Some(id) = id {
        return named(living, id);
    }
    ensure!(
        living.len() < 2,
        "several process sets are running; expected --run with one of: {}",
        ids(&living)
    );
    living.pop().with_context(none)
}

/// The run of this name, or, without one, the newest.
///
/// # Errors
/// There is no such run.
pub fn newest(id: Option<&str>) -> Result<Run> {
    let mut living = all();
    if let Some(id) = id {
        return named(living, id);
    }
    let started =
        |run: &Run| std::fs::metadata(run.directory().join("run.json")).and_then(|file| file.modified()).ok();
    living.sort_by_key(started);
    living.pop().with_context(none)
}

fn all() -> Vec<Run> {
    Run::all().into_iter().filter(Run::owner_lives).collect()
}

fn named(living: Vec<Run>, id: &str) -> Result<Run> {
    let known = ids(&living);
    if let Some(problem) = foreign(id) {
        bail!("run {id}: {problem}");
    }
    match living.into_iter().find(|run| run.id() == id) {
        Some(run) => Ok(run),
        None if known.is_empty() => bail!("there is no run {id}: {}", none()),
        None => bail!("there is no run {id}; running now: {known}"),
    }
}

/// Why a run that exists is not this user's.
fn foreign(id: &str) -> Option<RunError> {
    Run::named(id).err().filter(|error| matches!(error, RunError::Untrusted { .. }))
}

fn ids(living: &[Run]) -> String {
    living.iter().map(Run::id).collect::<Vec<_>>().join(", ")
}

fn none() -> &'static str {
    "no process set is running; expected one that was started with: coact launch"
}
