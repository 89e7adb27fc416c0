//! The file system in which POSIX shared memory lives: its free space, and one run's files in it.

use crate::{RunError, trust};
use std::fs::Permissions;
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::path::{Path, PathBuf};

pub(crate) const DIRECTORY: &str = "/dev/shm";
/// Free shared memory that a run needs, MiB. All ports of a full set, with a replacement beside each process, take about
/// 30 MiB; the rest is reserve.
const NEEDED_MIB: u64 = 48;

pub(crate) fn check_space() -> Result<(), RunError> {
    let path = Path::new(DIRECTORY);
    // No such file system, no limit to check: iceoryx2 then says itself what it lacks.
    let Ok(stat) = rustix::fs::statvfs(path) else { return Ok(()) };
    let free_mib = stat.f_bavail * stat.f_frsize / (1 << 20);
    if free_mib < NEEDED_MIB {
        return Err(RunError::SharedMemoryFull { path: path.to_owned(), free_mib, needed_mib: NEEDED_MIB });
    }
    Ok(())
}

/// Removes every shared-memory file of this user whose name starts with `prefix`.
pub(crate) fn wipe(prefix: &str) -> Result<(), RunError> {
    for path in files(prefix)? {
        match std::fs::remove_file(&path) {
            Err(cause) if cause.kind() != std::io::ErrorKind::NotFound => {
                return Err(RunError::File { path, operation: "cannot be removed", cause });
            }
            _ => {}
        }
    }
    Ok(())
}

/// Closes every shared-memory file of this user whose name starts with `prefix` to all other users.
pub(crate) fn close_to_others(prefix: &str) -> Result<(), RunError> {
    for path in files(prefix)? {
        // What is closed already stays as it is: its maker may be making it just now.
        if path.symlink_metadata().is_ok_and(|metadata| metadata.mode() & 0o077 == 0) {
            continue;
        }
        match std::fs::set_permissions(&path, Permissions::from_mode(0o600)) {
            Err(cause) if cause.kind() != std::io::ErrorKind::NotFound => {
                return Err(RunError::File { path, operation: "cannot be closed to other users", cause });
            }
            _ => {}
        }
    }
    Ok(())
}

/// The files of this user whose names start with `prefix`. What another user planted is not ours to touch.
fn files(prefix: &str) -> Result<Vec<PathBuf>, RunError> {
    let directory = Path::new(DIRECTORY);
    let Ok(entries) = std::fs::read_dir(directory) else { return Ok(Vec::new()) };
    let names = entries.filter_map(|entry| match entry {
        Ok(entry) => entry.file_name().to_string_lossy().starts_with(prefix).then(|| Ok(entry.path())),
        Err(cause) => {
            Some(Err(RunError::File { path: directory.to_owned(), operation: "cannot be listed", cause }))
        }
    });
    let own =
        |path: &Result<PathBuf, _>| path.as_ref().is_ok_and(|path| trust::is_own(path).unwrap_or(false));
    names.filter(|path| path.is_err() || own(path)).collect()
}
