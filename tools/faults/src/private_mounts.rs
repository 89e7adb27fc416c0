use crate::Trouble;
use rustix::mount::{MountFlags, MountPropagationFlags, UnmountFlags, mount, mount_change, unmount};
use rustix::thread::{UnshareFlags, unshare_unsafe};
use std::ffi::CStr;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// File systems in memory that only this thread, and what it starts, sees: they can be filled without striking anybody else.
#[derive(Debug, Default)]
pub(crate) struct PrivateMounts {
    mounted: Vec<PathBuf>,
}

/// Room in each: several times what a run needs.
const SIZE: &CStr = c"size=512m,mode=1777";
/// By so much at a time a file system is filled.
const PIECE: usize = 1 << 20;

impl PrivateMounts {
    /// Makes the calling thread's view of the file systems its own, for as long as the thread lives.
    ///
    /// # Errors
    /// The kernel grants it to root only.
    pub(crate) fn of_this_thread() -> Result<Self, Trouble> {
        let refused = Trouble::because("a file system of the run's own needs root");
        // SAFETY: no descriptor table is unshared; the thread changes neither its root nor its working directory.
        let own = unsafe { unshare_unsafe(UnshareFlags::NEWNS) };
        let private = MountPropagationFlags::PRIVATE | MountPropagationFlags::REC;
        own.and_then(|()| mount_change("/", private)).map_err(|error| refused(&error))?;
        Ok(Self::default())
    }

    /// An empty file system in the place of this folder.
    pub(crate) fn mount(&mut self, folder: &Path) -> Result<(), Trouble> {
        let refused = Trouble::because("no file system was mounted");
        mount("tmpfs", folder, "tmpfs", MountFlags::NOSUID, SIZE).map_err(|error| refused(&error))?;
        self.mounted.push(folder.to_owned());
        Ok(())
    }
}

impl Drop for PrivateMounts {
    fn drop(&mut self) {
        for folder in &self.mounted {
            // Refused, it goes with the thread and what that has started.
            unmount(folder, UnmountFlags::DETACH).ok();
        }
    }
}

/// What fills a file system until it is dropped.
#[derive(Debug)]
pub(crate) struct Filler {
    file: PathBuf,
}

impl Filler {
    /// Leaves no room in the file system of this folder, calling `meanwhile` again and again.
    pub(crate) fn fill(
        folder: &Path,
        mut meanwhile: impl FnMut() -> Result<(), Trouble>,
    ) -> Result<Self, Trouble> {
        let failed = |error: io::Error| Trouble::because("the file system was not filled")(&error);
        let filler = Self { file: folder.join("filler") };
        let mut file = File::create(&filler.file).map_err(failed)?;
        let mut piece = PIECE;
        while piece > 0 {
            meanwhile()?;
            match file.write_all(&vec![0; piece]) {
                Ok(()) => {}
                Err(error) if error.kind() == io::ErrorKind::StorageFull => piece /= 2,
                Err(error) => return Err(failed(error)),
            }
        }
        Ok(filler)
    }
}

impl Drop for Filler {
    fn drop(&mut self) {
        // Refused, it goes with its file system.
        std::fs::remove_file(&self.file).ok();
    }
}
