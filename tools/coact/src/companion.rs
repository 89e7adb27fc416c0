//! Programs that belong to this one, and are built when they are first used: who only starts runs need not wait for them.

use crate::installation::Installation;
use anyhow::{Context, Error, Result, bail, ensure};
use std::io::IsTerminal;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::SystemTime;

/// The workspace that this program was built from.
const SOURCES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// Becomes another program; returns only what prevented it.
pub(crate) fn become_it(mut command: Command) -> Error {
    let program = Path::new(command.get_program()).display().to_string();
    Error::new(command.exec()).context(format!("{program}: cannot be started"))
}

/// The program beside this one, which users know by `name`, built first when there is none or when it is older than this one.
///
/// # Errors
/// It cannot be built.
pub(crate) fn up_to_date(program: &str, name: &str) -> Result<PathBuf> {
    let programs = Installation::programs()?;
    let own = std::env::current_exe().context("this program's own place is unknown")?;
    let path = programs.join(program);
    match (modified(&path), modified(&own)) {
        (Some(built), Some(own)) if built >= own => return Ok(path),
        (Some(_), _) => eprintln!("building {name} anew: they are older than coact"),
        (None, _) => eprintln!("building {name}, once: about a minute"),
    }
    build(program, &programs).with_context(|| {
        format!(
            "{program} was not built; expected it in {}, from: cargo build --release -p {program}",
            programs.display()
        )
    })?;
    // Cargo does not touch what was up to date already.
    let touched = std::fs::File::open(&path).and_then(|file| file.set_modified(SystemTime::now()));
    touched.with_context(|| format!("{}: expected what cargo has built", path.display()))?;
    Ok(path)
}

fn modified(file: &Path) -> Option<SystemTime> {
    std::fs::metadata(file).and_then(|file| file.modified()).ok()
}

/// Builds a program as this one was built: from the same sources, into the same folder.
fn build(program: &str, programs: &Path) -> Result<()> {
    let manifest = Path::new(SOURCES).join("Cargo.toml");
    ensure!(manifest.is_file(), "{}: the sources of this program are gone", manifest.display());
    let (Some(target), Some(folder)) = (programs.parent(), programs.file_name()) else {
        bail!("{}: expected a folder that cargo builds into", programs.display());
    };
    // Cargo marks its own folder by this file.
    let own = target.join("CACHEDIR.TAG").is_file();
    ensure!(own, "{}: expected a folder that cargo builds into", programs.display());
    let mut cargo = Command::new("cargo");
    cargo.args(["build", "-p", program, "--manifest-path"]).arg(manifest);
    cargo.arg("--target-dir").arg(target).arg("--profile");
    cargo.arg(if folder == "debug" { "dev".as_ref() } else { folder });
    // On a terminal cargo shows its progress; elsewhere only its errors are of interest.
    if !std::io::stderr().is_terminal() {
        cargo.arg("--quiet");
    }
    let status = cargo.stdin(Stdio::null()).stdout(Stdio::null()).status();
    let status = status.context("cargo cannot be started; install Rust from https://rustup.rs")?;
    ensure!(status.success(), "the build failed; the errors stand above");
    Ok(())
}
