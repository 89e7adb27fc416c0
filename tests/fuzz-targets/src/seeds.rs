use crate::Target;
use std::path::{Path, PathBuf};

/// Bytes to begin with.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Seed {
    /// Where they are kept.
    pub path: PathBuf,
    /// The bytes.
    pub bytes: Vec<u8>,
    /// Whether the target must take them in: what the project ships, and what is kept under a name that begins with "good".
    pub good: bool,
}

/// Root of the checkout.
pub fn checkout() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The seeds of a target, in the order of their names: the files that the project ships, then the kept ones.
///
/// # Panics
/// A seed cannot be read, or a file that is named is not there.
pub fn seeds(target: &Target) -> Vec<Seed> {
    let shipped = target.seeds.iter().flat_map(|pattern| {
        let found = shipped(pattern);
        assert!(!found.is_empty(), "{}: no file {pattern}", target.name);
        found
    });
    let kept = files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target.name));
    let is_good = |path: &Path| path.file_name().unwrap().to_string_lossy().starts_with("good");
    let all = shipped.map(|path| (path, true)).chain(kept.into_iter().map(|path| {
        let good = is_good(&path);
        (path, good)
    }));
    all.map(|(path, good)| Seed { bytes: std::fs::read(&path).unwrap(), path, good }).collect()
}

/// The files that a pattern names; one `*` may stand in its last part.
fn shipped(pattern: &str) -> Vec<PathBuf> {
    let path = checkout().join(pattern);
    let name = path.file_name().unwrap().to_str().unwrap().to_owned();
    let Some((begin, end)) = name.split_once('*') else { return vec![path] };
    let fits = |path: &PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy();
        name.starts_with(begin) && name.ends_with(end)
    };
    files(path.parent().unwrap()).into_iter().filter(fits).collect()
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let mut files: Vec<_> =
        entries.map(|entry| entry.unwrap().path()).filter(|path| path.is_file()).collect();
    files.sort();
    files
}
