use crate::BenchError;
use std::path::{Path, PathBuf};
use toml_edit::{DocumentMut, value};

/// More restarts than any bench makes.
const INTENSITY: i64 = 1_000_000;
/// Restarts this far apart are immediate, s.
const WINDOW: f64 = 0.1;

/// Writes a process table into `folder`, with the verdict's rules that belong beside it, and returns its file: `table`, but no process is
/// ever given up, and each of the stages `with_standby` has one.
///
/// # Errors
/// [`BenchError::Table`] when a file cannot be read or written.
pub fn tireless_table(
    table: &Path,
    rules: &Path,
    with_standby: &[&str],
    folder: &Path,
) -> Result<PathBuf, BenchError> {
    let at = |file: &Path| {
        let file = file.to_owned();
        move |cause: &dyn std::fmt::Display| BenchError::Table { file, cause: cause.to_string() }
    };
    let text = std::fs::read_to_string(table).map_err(|cause| at(table)(&cause))?;
    let mut document: DocumentMut = text.parse().map_err(|cause| at(table)(&cause))?;
    document["restart"]["intensity"] = value(INTENSITY);
    document["restart"]["window_s"] = value(WINDOW);
    let processes = document["process"].as_array_of_tables_mut().into_iter().flat_map(|all| all.iter_mut());
    for process in processes {
        if process["name"].as_str().is_some_and(|name| with_standby.contains(&name)) {
            process["standby"] = value(true);
        }
    }
    let file = folder.join("pipeline.toml");
    std::fs::write(&file, document.to_string()).map_err(|cause| at(&file)(&cause))?;
    let beside = folder.join(rules.file_name().unwrap_or_default());
    std::fs::copy(rules, &beside).map_err(|cause| at(&beside)(&cause))?;
    Ok(file)
}
