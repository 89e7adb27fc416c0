use rustix::fs::{FlockOperation, flock};
use rustix::io::{Errno, retry_on_intr};
use std::fs::{File, OpenOptions};
use std::io;
use std::os::unix::fs::{MetadataExt, OpenOptionsExt};
use std::path::{Path, PathBuf};

/// The lock by which a run is owned: a locked file in its directory. The kernel releases it when the owner ends, however
/// that happens; a process id would come again, and means nothing in another PID namespace.
///
/// A second file beside it is locked, shared, by each process that lives on when the owner dies ([`Membership`](crate::Membership)): as long
/// as there is one, the run is no remains.
#[derive(Debug)]
pub(crate) struct RunLock {
    /// Locked as long as it is open.
    _file: File,
}

/// What a look at a run's lock tells.
#[derive(Debug)]
pub(crate) enum Held {
    /// The owner lives.
    ByOwner,
    /// Nobody holds it; as long as this value lives, the caller does.
    ByCaller(RunLock),
}

impl RunLock {
    /// Makes the lock of a new run's directory and takes it.
    ///
    /// # Errors
    /// The file cannot be made; or someone took the directory for remains, and removed it.
    pub(crate) fn create(directory: &Path) -> io::Result<Self> {
        let path = lock_of(directory);
        let file = OpenOptions::new().write(true).create_new(true).mode(0o600).open(&path)?;
        flock(&file, FlockOperation::LockExclusive)?;
        // Between making and locking, who removes remains may have been quicker.
        match std::fs::metadata(&path) {
            Ok(found) if found.ino() == file.metadata()?.ino() => Ok(Self { _file: file }),
            _ => Err(io::ErrorKind::NotFound.into()),
        }
    }

    /// Who holds the lock of the run in `directory`; takes it when nobody does.
    ///
    /// # Errors
    /// There is no lock, or it cannot be opened.
    pub(crate) fn look(directory: &Path) -> io::Result<Held> {
        let file = File::open(lock_of(directory))?;
        match flock(&file, FlockOperation::NonBlockingLockExclusive) {
            Ok(()) => Ok(Held::ByCaller(Self { _file: file })),
            Err(Errno::WOULDBLOCK) => Ok(Held::ByOwner),
            Err(error) => Err(error.into()),
        }
    }

    /// Whether anybody holds the lock of the run in `directory`.
    pub(crate) fn is_held(directory: &Path) -> bool {
        // Shared, so that two that look at the same time do not take each other for the owner.
        is_locked_against(&lock_of(directory), FlockOperation::NonBlockingLockShared)
    }

    /// Waits until the owner has died. Who waits uses no time, and is woken by the kernel.
    ///
    /// # Errors
    /// There is no lock, or it cannot be opened.
    pub(crate) fn wait_for_release(directory: &Path) -> io::Result<()> {
        let file = File::open(lock_of(directory))?;
        Ok(retry_on_intr(|| flock(&file, FlockOperation::LockShared))?)
    }
}

/// Whether somebody's lock excludes this one.
pub(crate) fn is_locked_against(path: &Path, operation: FlockOperation) -> bool {
    File::open(path).is_ok_and(|file| flock(&file, operation) == Err(Errno::WOULDBLOCK))
}

fn lock_of(directory: &Path) -> PathBuf {
    directory.join("lock")
}
