use std::cell::RefCell;
use std::fs::Permissions;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

/// A folder of one target on one thread, removed with the thread: for readers that read files.
pub(crate) struct Scratch {
    folder: tempfile::TempDir,
}

thread_local! {
    static FOLDER: RefCell<Option<Scratch>> = const { RefCell::new(None) };
}

/// Where no disk is waited for, if there is such a place.
const MEMORY: &str = "/dev/shm";

impl Scratch {
    fn new() -> Self {
        let in_memory = tempfile::Builder::new().prefix("fuzz-").tempdir_in(MEMORY);
        Self { folder: in_memory.or_else(|_| tempfile::tempdir()).unwrap() }
    }

    /// What `read` makes of the bytes, given them as a file of this name, which may begin with folders.
    pub(crate) fn with<R>(name: &str, bytes: &[u8], read: impl FnOnce(&Path) -> R) -> R {
        let path = Self::file(name, bytes);
        read(&path)
    }

    /// Writes a file that nobody else may open.
    pub(crate) fn file(name: &str, bytes: &[u8]) -> PathBuf {
        let path = Self::folder().join(name);
        let folder = path.parent().unwrap();
        if !folder.is_dir() {
            std::fs::create_dir_all(folder).unwrap();
            std::fs::set_permissions(folder, Permissions::from_mode(0o700)).unwrap();
        }
        let is_new = !path.exists();
        std::fs::write(&path, bytes).unwrap();
        if is_new {
            std::fs::set_permissions(&path, Permissions::from_mode(0o600)).unwrap();
        }
        path
    }

    /// The folder.
    pub(crate) fn folder() -> PathBuf {
        FOLDER.with_borrow_mut(|kept| kept.get_or_insert_with(Self::new).folder.path().to_owned())
    }
}
