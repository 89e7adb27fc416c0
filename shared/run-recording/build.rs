//! Tells the code that a recording was made by: a fingerprint of all sources that decide what stages compute.

use std::fs;
use std::hash::{DefaultHasher, Hasher};
use std::path::{Path, PathBuf};

/// From this package's folder.
const SOURCES: [&str; 4] =
    ["../../shared", "../../services/perception/src", "../../services/fields/src", "../../Cargo.lock"];

fn main() {
    let mut files = Vec::new();
    for source in SOURCES {
        println!("cargo:rerun-if-changed={source}");
        collect(Path::new(source), &mut files);
    }
    files.sort();
    let mut hash = DefaultHasher::new();
    for file in files {
        hash.write(&fs::read(file).unwrap_or_default());
    }
    println!("cargo:rustc-env=COACT_CODE={:016x}", hash.finish());
}

/// The sources in a folder and below: tests and documents decide nothing.
fn collect(path: &Path, files: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(path) else { return files.push(path.to_owned()) };
    for entry in entries.filter_map(Result::ok) {
        let (path, is_folder) = (entry.path(), entry.file_type().is_ok_and(|kind| kind.is_dir()));
        if is_folder && !path.ends_with("tests") {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}
