//! Process sets that are running now, and those whose supervisor has died.

use anyhow::{Context, Result, bail, ensure};
use coact_pipeline::{Run, RunError};

/// The run of this name, or, without one, the only one.
///
/// # Errors
/// There is no such run, or there are several; or its supervisor has died.
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
/// There is no such run, or its supervisor has died.
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

/// The orphaned run of this name, or, without one, the only one.
///
/// # Errors
/// There is no such run, or there are several; or it has a supervisor, or no processes any more.
pub fn orphaned(id: Option<&str>) -> Result<Run> {
    let mut orphaned = all_orphaned();
    let Some(id) = id else {
        ensure!(orphaned.len() < 2, "several runs are orphaned; expected one of: {}", ids(&orphaned));
        return orphaned.pop().with_context(|| format!("no run is orphaned; {EXPECTED_ORPHAN}"));
    };
    if let Some(found) = orphaned.iter().position(|run| run.id() == id) {
        return Ok(orphaned.swap_remove(found));
    }
    if let Some(problem) = foreign(id) {
        bail!("run {id}: {problem}");
    }
    match Run::named(id) {
        Ok(run) if run.owner_lives() => {
            let owner = run.owner()?.pid;
            bail!("run {id}: its supervisor lives, as process {owner}; {EXPECTED_ORPHAN}")
        }
        Ok(_) => bail!("run {id}: none of its processes lives any more; {EXPECTED_ORPHAN}"),
        Err(_) => bail!("there is no run {id}; {EXPECTED_ORPHAN}"),
    }
}

/// What can be adopted.
const EXPECTED_ORPHAN: &str = "expected one whose supervisor has died and whose processes live on: as long as \
                               adoptable_for_s in its process table says";

fn all() -> Vec<Run> {
    Run::all().into_iter().filter(Run::owner_lives).collect()
}

fn all_orphaned() -> Vec<Run> {
    Run::all().into_iter().filter(Run::is_orphaned).collect()
}

fn named(living: Vec<Run>, id: &str) -> Result<Run> {
    let known = ids(&living);
    if let Some(problem) = foreign(id) {
        bail!("run {id}: {problem}");
    }
    match living.into_iter().find(|run| run.id() == id) {
        Some(run) => Ok(run),
        None if all_orphaned().iter().any(|run| run.id() == id) => bail!(orphan(id)),
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

fn orphan(id: &str) -> String {
    format!("the supervisor of run {id} has died, and its robot stands; adopt the run with: coact adopt {id}")
}

fn none() -> String {
    match all_orphaned().first() {
        Some(run) => orphan(run.id()),
        None => "no process set is running; expected one that was started with: coact launch".into(),
    }
}
