use crate::companion;
use crate::installation::Installation;
use anyhow::{Result, ensure};
use std::path::{PathBuf, absolute};
use std::process::{Command, ExitCode};

/// Shows a recorded run in the browser: what was seen, thought, said and done, and why. Of a run that goes on: coact launch --console.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact console reports/mine/run.mcap     prints an address to be opened in a browser; Ctrl-C ends
  coact launch --console                  a run that goes on, to be watched and played with")]
pub struct Args {
    /// What coact launch --record, or --console, has recorded
    #[arg(value_name = "FILE")]
    recording: PathBuf,
}

/// Name of the program and of its package.
const PROGRAM: &str = "coact-console";

/// The console, built first when there is none. `tools/launch` builds it anew where it has changed.
///
/// # Errors
/// It cannot be built.
pub(crate) fn program() -> Result<PathBuf> {
    let path = Installation::programs()?.join(PROGRAM);
    if path.is_file() { Ok(path) } else { companion::up_to_date(PROGRAM, "the console") }
}

/// Becomes the console.
///
/// # Errors
/// There is no such file, or the console cannot be built.
pub fn run(args: Args) -> Result<ExitCode> {
    let file = absolute(&args.recording)?;
    ensure!(
        file.is_file(),
        "{}: there is no such file; expected a recording: coact launch --record",
        args.recording.display()
    );
    let settings = Installation::find()?.configuration.join("console.toml");
    let mut command = Command::new(program()?);
    command.arg("--recording").args([file, settings]);
    Err(companion::become_it(command))
}
