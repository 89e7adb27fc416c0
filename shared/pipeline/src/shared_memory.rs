//! The file system in which POSIX shared memory lives: its free space, and one run's files in it.

use crate::RunError;
use std::path::Path;

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

/// Removes every shared-memory file whose name starts with `prefix`.
pub(crate) fn wipe(prefix: &str) -> Result<(), RunError> {
    let failed = |operation, path: &Path, cause| RunError::File { path: path.to_owned(), operation, cause };
    let directory = Path::new(DIRECTORY);
    let Ok(entries) = std::fs::read_dir(directory) else { return Ok(()) };
    for entry in entries {
        let entry = entry.map_err(|cause| failed("cannot be listed", directory, cause))?;
        if !entry.file_name().to_string_lossy().starts_with(prefix) {
            continue;
        }
        match std::fs::remove_file(entry.path()) {
            Err(cause) if cause.kind() != std::io::ErrorKind::NotFound => {
                return Err(failed("cannot be removed", &entry.path(), cause));
            }
            _ => {}
        }
    }
    Ok(())
}
