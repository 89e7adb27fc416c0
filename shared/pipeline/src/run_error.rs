use std::path::PathBuf;

/// Why a run directory could not be made or used.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// A file or directory of the run refused an operation. The message contains the cause, so that it is no source as
    /// well.
    #[error("{}: {operation}: {cause}", path.display())]
    File {
        /// The file or directory.
        path: PathBuf,
        /// What was tried.
        operation: &'static str,
        /// Why it failed.
        cause: std::io::Error,
    },
    /// A file of the run does not contain what it should.
    #[error("{}: {problem}; expected a file that a coact supervisor of this version wrote", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        problem: String,
    },
    /// Another user may have made or changed it.
    #[error("{}: {problem}; expected {kind} of this user that nobody else can open, as coact makes it", path.display())]
    Untrusted {
        /// The file or directory.
        path: PathBuf,
        /// Why it is not trusted.
        problem: String,
        /// What it should be.
        kind: &'static str,
    },
    /// The run's lock is held by its supervisor or its processes, or there is none.
    #[error("{}: nothing says that its supervisor and its processes have ended; expected a lock that nobody holds", path.display())]
    Owned {
        /// The run directory.
        path: PathBuf,
    },
    /// The run has nobody to adopt, or a supervisor.
    #[error("{}: {problem}; expected a run whose supervisor has died and whose processes live on", path.display())]
    NotOrphaned {
        /// The run directory.
        path: PathBuf,
        /// Why it cannot be adopted.
        problem: &'static str,
    },
    /// Shared memory is full: a process that touches a page it does not get is killed by SIGBUS.
    #[error(
        "{}: {free_mib} MiB of shared memory are free; expected at least {needed_mib} MiB: remove stale files or remount it larger",
        path.display()
    )]
    SharedMemoryFull {
        /// The file system of shared memory.
        path: PathBuf,
        /// Free space, MiB.
        free_mib: u64,
        /// Space that a run needs, MiB.
        needed_mib: u64,
    },
}
