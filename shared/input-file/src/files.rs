use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io::{Error, ErrorKind};
use std::path::{Component, Path, PathBuf};

/// Contents of files, by the paths by which they were read: taken down while somebody loads something, and given in the place
/// of the files when the same is loaded elsewhere.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Files(BTreeMap<PathBuf, Vec<u8>>);

thread_local! {
    static ROLE: RefCell<Role> = const { RefCell::new(Role::None) };
}

/// What the files are for on this thread.
enum Role {
    None,
    /// What is read is taken down.
    Notes(Files),
    /// What is read is given from here, and nothing else.
    Source(Files),
}

/// Gives the thread back its role, also when what was loaded panics.
struct Restored(Option<Role>);

impl Drop for Restored {
    fn drop(&mut self) {
        if let Some(before) = self.0.take() {
            ROLE.set(before);
        }
    }
}

impl Files {
    /// Does `work`, and takes down all files that it reads on this thread.
    ///
    /// ```
    /// use coact_input_file::{Files, read_text};
    ///
    /// let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml");
    /// let (text, files) = Files::noted(|| read_text(&path));
    /// assert_eq!(files.iter().next(), Some((path.as_path(), text?.as_bytes())));
    /// // Elsewhere there may be no such file:
    /// assert!(files.provided(|| read_text(&path))?.starts_with("[package]"));
    /// # Ok::<(), std::io::Error>(())
    /// ```
    pub fn noted<T>(work: impl FnOnce() -> T) -> (T, Self) {
        let _restored = Restored(Some(ROLE.replace(Role::Notes(Self::default()))));
        let done = work();
        match ROLE.replace(Role::None) {
            Role::Notes(files) => (done, files),
            _ => (done, Self::default()),
        }
    }

    /// Does `work`, which finds these files and no others on this thread.
    pub fn provided<T>(&self, work: impl FnOnce() -> T) -> T {
        let _restored = Restored(Some(ROLE.replace(Role::Source(self.clone()))));
        work()
    }

    /// Adds a file.
    pub fn insert(&mut self, path: &Path, contents: Vec<u8>) {
        self.0.insert(plain(path), contents);
    }

    /// All files, by their paths.
    pub fn iter(&self) -> impl Iterator<Item = (&Path, &[u8])> {
        self.0.iter().map(|(path, contents)| (path.as_path(), contents.as_slice()))
    }

    fn get(&self, path: &Path) -> Option<&Vec<u8>> {
        self.0.get(&plain(path))
    }
}

/// The path without `.` and `..`: the same file, however it is named.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => drop(plain.pop()),
            _ => plain.push(part),
        }
    }
    plain
}

/// The contents, where files are given on this thread; `None` where they are not.
pub(crate) fn given(path: &Path, longest: u64) -> Option<Result<Vec<u8>, Error>> {
    ROLE.with_borrow(|role| {
        let Role::Source(files) = role else { return None };
        let found = files.get(path).filter(|contents| contents.len() as u64 <= longest);
        let missing =
            || Error::new(ErrorKind::NotFound, "is not among the files that are given, or is too long");
        Some(found.cloned().ok_or_else(missing))
    })
}

/// Takes a file down, if this thread takes files down.
pub(crate) fn note(path: &Path, contents: &[u8]) {
    ROLE.with_borrow_mut(|role| {
        if let Role::Notes(files) = role {
            files.insert(path, contents.to_vec());
        }
    });
}
