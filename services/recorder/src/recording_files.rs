//! Names of a run's recordings: `run.mcap`; of a recorder that was restarted, `run-2.mcap`, and so on.

use std::io;
use std::path::{Path, PathBuf};

/// The recording of the recorder that was restarted so many times.
pub fn recording_file(report: &Path, generation: u32) -> PathBuf {
    match generation {
        0 => report.join("run.mcap"),
        _ => report.join(format!("run-{}.mcap", generation + 1)),
    }
}

/// Removes what an earlier run has left in the folder.
///
/// # Errors
/// A file cannot be removed.
pub fn remove_recordings(report: &Path) -> io::Result<()> {
    let entries = std::fs::read_dir(report)?.filter_map(Result::ok);
    entries
        .filter(|entry| is_recording(&entry.file_name().to_string_lossy()))
        .try_for_each(|entry| std::fs::remove_file(entry.path()))
}

fn is_recording(name: &str) -> bool {
    let number = name.strip_prefix("run").and_then(|rest| rest.strip_suffix(".mcap"));
    let is_number = |digits: &str| digits.parse::<u32>().is_ok();
    number.is_some_and(|number| number.is_empty() || number.strip_prefix('-').is_some_and(is_number))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn only_recordings_of_runs_are_removed() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        for name in ["run.mcap", "run-2.mcap", "run-x.mcap", "my-run.mcap"] {
            std::fs::write(path(name), "").unwrap();
        }
        remove_recordings(folder.path()).unwrap();
        let left = ["run.mcap", "run-2.mcap", "run-x.mcap", "my-run.mcap"].map(|name| path(name).exists());
        assert_eq!(left, [false, false, true, true]);
        assert_eq!(recording_file(folder.path(), 1), path("run-2.mcap"));
    }
}
