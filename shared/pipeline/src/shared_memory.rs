//! The file system in which POSIX shared memory lives: its free space, and one run's files in it.

use crate::{RunError, trust};
use rustix::fs::{FallocateFlags, fallocate};
use std::fs::{OpenOptions, Permissions};
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::path::{Path, PathBuf};

pub(crate) const DIRECTORY: &str = "/dev/shm";
/// Free shared memory that a run needs, MiB. All ports of a full set take 26.5 MiB (measured), as much again is held for
/// replacements; the rest is for viewers.
const NEEDED_MIB: u64 = 64;

/// What `st_blocks` counts in.
const BLOCK: u64 = 512;

pub(crate) fn check_space() -> Result<(), RunError> {
    let path = Path::new(DIRECTORY);
    // No such file system, no limit to check: iceoryx2 then says itself what it lacks.
    let Some(free_mib) = free_mib(path) else { return Ok(()) };
    if free_mib < NEEDED_MIB {
        return Err(RunError::SharedMemoryFull { path: path.to_owned(), free_mib, needed_mib: NEEDED_MIB });
    }
    Ok(())
}

fn free_mib(path: &Path) -> Option<u64> {
    let stat = rustix::fs::statvfs(path).ok()?;
    Some(stat.f_bavail * stat.f_frsize / (1 << 20))
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

/// Allocates every page of the files whose names start with `prefix`; returns how many bytes they have. A page that is not
/// allocated is looked for when it is touched first, and where there is none left, who touches it is killed by SIGBUS.
pub(crate) fn allocate(prefix: &str) -> Result<u64, RunError> {
    let mut bytes = 0;
    for path in files(prefix)? {
        // What is just being made or removed is left to its maker.
        let Ok(file) = OpenOptions::new().write(true).open(&path) else { continue };
        let Ok(metadata) = file.metadata() else { continue };
        bytes += metadata.len();
        let allocated = metadata.blocks() * BLOCK;
        if allocated < metadata.len() {
            fallocate(&file, FallocateFlags::empty(), 0, metadata.len())
                .map_err(|_| full(metadata.len() - allocated))?;
        }
    }
    Ok(bytes)
}

/// Where the file called `name` lies.
pub(crate) fn path(name: &str) -> PathBuf {
    Path::new(DIRECTORY).join(name)
}

/// The error that so many bytes more were needed.
pub(crate) fn full(bytes: u64) -> RunError {
    let path = Path::new(DIRECTORY).to_owned();
    let free_mib = free_mib(&path).unwrap_or(0);
    RunError::SharedMemoryFull { path, free_mib, needed_mib: bytes.div_ceil(1 << 20).max(free_mib + 1) }
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
