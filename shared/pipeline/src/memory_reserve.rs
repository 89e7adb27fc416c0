use crate::{Run, RunError, shared_memory};
use rustix::fs::{FallocateFlags, fallocate, fstatvfs, ftruncate};
use std::fs::{File, OpenOptions};
use std::os::unix::fs::OpenOptionsExt;
use std::path::PathBuf;

/// Shared memory that is held for replacements: a file whose pages are allocated, released just before a replacement is
/// started, and taken again afterwards. So a replacement finds room whatever else has filled the file system meanwhile.
#[derive(Debug)]
pub struct MemoryReserve {
    path: PathBuf,
    file: File,
    bytes: u64,
}

impl MemoryReserve {
    /// Allocates every page of the run's shared memory, and as much again for one replacement of each process. Nobody is
    /// killed any more for touching a page that is not there.
    ///
    /// # Errors
    /// [`RunError::SharedMemoryFull`], or [`RunError::File`].
    pub fn take(run: &Run) -> Result<Self, RunError> {
        let bytes = shared_memory::allocate(&run.prefix())?;
        let path = shared_memory::path(&Self::name(run));
        let file = OpenOptions::new().write(true).create_new(true).mode(0o600).open(&path);
        let file =
            file.map_err(|cause| RunError::File { path: path.clone(), operation: "cannot be made", cause })?;
        let reserve = Self { path, file, bytes };
        reserve.fill()?;
        Ok(reserve)
    }

    /// What the file is called.
    pub(crate) fn name(run: &Run) -> String {
        format!("{}reserve", run.prefix())
    }

    /// Makes room for a replacement, where there is no other: to give memory back takes milliseconds, in which nobody is started.
    ///
    /// # Errors
    /// [`RunError::File`].
    pub fn release(&self) -> Result<(), RunError> {
        let free = fstatvfs(&self.file).map_or(0, |system| system.f_bavail * system.f_frsize);
        if free >= self.bytes {
            return Ok(());
        }
        ftruncate(&self.file, 0).map_err(|error| RunError::File {
            path: self.path.clone(),
            operation: "cannot be emptied",
            cause: error.into(),
        })
    }

    /// Allocates what a replacement has made since, and takes the reserve again.
    ///
    /// # Errors
    /// As [`MemoryReserve::take`]; the next replacement may then find no room.
    pub fn renew(&self, run: &Run) -> Result<(), RunError> {
        shared_memory::allocate(&run.prefix())?;
        self.fill()
    }

    fn fill(&self) -> Result<(), RunError> {
        fallocate(&self.file, FallocateFlags::empty(), 0, self.bytes.max(1))
            .map_err(|_| shared_memory::full(self.bytes))
    }
}
