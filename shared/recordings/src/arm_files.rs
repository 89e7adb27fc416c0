use crate::RecordingError;
use std::path::{Path, PathBuf};

/// The files of motion capture (`.csv`) in a folder and in the folders that it holds, in the order of their names.
///
/// # Errors
/// [`RecordingError`] when a folder cannot be read, or there is no such file.
pub fn arm_files(folder: &Path) -> Result<Vec<PathBuf>, RecordingError> {
    let (mut files, mut folders) = (Vec::new(), Vec::new());
    for entry in entries(folder)? {
        if entry.is_dir() { folders.push(entry) } else { files.push(entry) }
    }
    for folder in folders {
        files.extend(entries(&folder)?);
    }
    files.retain(|file| file.is_file() && file.extension().is_some_and(|extension| extension == "csv"));
    files.sort();
    if files.is_empty() {
        return Err(RecordingError::NoArms { path: folder.to_path_buf() });
    }
    Ok(files)
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, RecordingError> {
    let io = |reason| RecordingError::Io { path: folder.to_path_buf(), reason };
    std::fs::read_dir(folder).map_err(io)?.map(|entry| Ok(entry.map_err(io)?.path())).collect()
}
