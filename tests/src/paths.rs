use coact_pipeline::Run;
use std::path::{Path, PathBuf};

/// Root of the checkout.
pub fn checkout() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

/// The program `coact`, in the folder above that of this test's own program.
///
/// # Panics
/// It was not built.
pub fn coact() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let program = test.parent().unwrap().parent().unwrap().join("coact");
    assert!(program.is_file(), "{} is missing: cargo build --workspace --bins", program.display());
    program
}

/// Where shared memory lies.
pub fn shared_memory() -> &'static Path {
    Path::new("/dev/shm")
}

/// All that is left of a run: names in shared memory and in the temporary directory.
pub fn left_behind(run: &Run) -> Vec<String> {
    let name = format!("coact_{}", run.id());
    let names = |folder: &Path| {
        let entries = std::fs::read_dir(folder).into_iter().flatten();
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect::<Vec<_>>()
    };
    let mut left = names(shared_memory());
    left.extend(names(&std::env::temp_dir()));
    left.retain(|entry| *entry == name || entry.starts_with(&format!("{name}_")));
    left
}
