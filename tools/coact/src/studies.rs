//! Commands that no run needs: those of the program `coact-studies` beside this one, which is built when it is first used.

use crate::installation::Installation;
use anyhow::{Context, Error, Result, bail, ensure};
use std::ffi::OsString;
use std::io::IsTerminal;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::SystemTime;

/// Name and description of each study.
pub const STUDIES: [(&str, &str); 12] = [
    ("task", "Show what is made of a task file"),
    ("learn", "Learn connections of the network: a plan from demonstrations, what acts show"),
    ("reaches", "Measure anticipation on recorded reaches of real people"),
    ("evaluate", "Evaluate whole assemblies with random partners, and compare with ablations"),
    ("bench", "Measure latencies beside an idle thread and iceoryx2 alone, under load and with kills"),
    ("separation", "Measure the separation of the working robot from recorded people"),
    ("faults", "Break process sets in every way, and judge what happens"),
    ("replay", "Compute a recorded run again, and compare it with the recording to the bit"),
    ("figures", "Draw the chapter's figures from runs made now"),
    ("motion", "Plan a movement of the arm, or measure the planner"),
    ("train", "Train the model of preshaping from recorded reaches"),
    ("completions", "Print completions for a shell"),
];

/// Name of the program and of its package.
const PROGRAM: &str = "coact-studies";

/// The workspace that this program was built from.
const SOURCES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// Whether these arguments, or the help that they ask for, are those of a study.
pub fn are_meant(arguments: &[OsString]) -> bool {
    let command = match arguments {
        [help, command, ..] if help == "help" => Some(command),
        arguments => arguments.first(),
    };
    command.is_some_and(|command| STUDIES.iter().any(|(name, _)| command == name))
}

/// Becomes the program of the studies, with these arguments; returns only what prevented it.
pub fn run(arguments: &[OsString]) -> Error {
    match up_to_date() {
        Ok(program) => {
            let error = Command::new(&program).args(arguments).exec();
            Error::new(error).context(format!("{}: cannot be started", program.display()))
        }
        Err(error) => error,
    }
}

/// The program of the studies, built first when there is none or when it is older than this one.
fn up_to_date() -> Result<PathBuf> {
    let programs = Installation::programs()?;
    let own = std::env::current_exe().context("this program's own place is unknown")?;
    let studies = programs.join(PROGRAM);
    match (modified(&studies), modified(&own)) {
        (Some(built), Some(own)) if built >= own => return Ok(studies),
        (Some(_), _) => eprintln!("building the studies anew: they are older than coact"),
        (None, _) => eprintln!("building the studies, once: about a minute"),
    }
    build(&programs).with_context(|| {
        format!(
            "{PROGRAM} was not built; expected it in {}, from: cargo build --release -p {PROGRAM}",
            programs.display()
        )
    })?;
    // Cargo does not touch what was up to date already.
    let touched = std::fs::File::open(&studies).and_then(|file| file.set_modified(SystemTime::now()));
    touched.with_context(|| format!("{}: expected what cargo has built", studies.display()))?;
    Ok(studies)
}

fn modified(file: &Path) -> Option<SystemTime> {
    std::fs::metadata(file).and_then(|file| file.modified()).ok()
}

/// Builds the studies as this program was built: from the same sources, into the same folder.
fn build(programs: &Path) -> Result<()> {
    let manifest = Path::new(SOURCES).join("Cargo.toml");
    ensure!(manifest.is_file(), "{}: the sources of this program are gone", manifest.display());
    let (Some(target), Some(folder)) = (programs.parent(), programs.file_name()) else {
        bail!("{}: expected a folder that cargo builds into", programs.display());
    };
    // Cargo marks its own folder by this file.
    let own = target.join("CACHEDIR.TAG").is_file();
    ensure!(own, "{}: expected a folder that cargo builds into", programs.display());
    let mut cargo = Command::new("cargo");
    cargo.args(["build", "-p", PROGRAM, "--manifest-path"]).arg(manifest);
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
