use crate::Trial;
use coact_monitor::plots::{PlotError, gantt};
use std::path::Path;

/// Draws who did what in the completed assembly of median duration; nothing where none was completed.
///
/// # Errors
/// The file cannot be written.
pub fn draw_timeline(trials: &[Trial], path: &Path) -> Result<(), PlotError> {
    let mut completed: Vec<&Trial> = trials.iter().filter(|trial| trial.completed_ms.is_some()).collect();
    completed.sort_by_key(|trial| trial.ended_ms);
    let Some(median) = completed.get(completed.len() / 2) else { return Ok(()) };
    let Trial { task, seed, ended_ms, .. } = median;
    let caption = format!("{task}, seed {seed}: {:.1} s", *ended_ms as f64 / 1e3);
    gantt(&median.timeline, &caption, path)
}
