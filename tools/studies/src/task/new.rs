//! `coact task new`: a commented task file to begin with.

use anyhow::{Context, Result, bail};
use coact::installation::Installation;
use coact_learning::TaskText;
use std::path::PathBuf;
use std::process::ExitCode;

/// Arguments of `coact task new`.
#[derive(clap::Args)]
#[command(after_help = "Example:
  coact task new --out rt-config/tasks/mine.toml
  coact task check rt-config/tasks/mine.toml
  coact launch --lockstep --task rt-config/tasks/mine.toml")]
pub struct Args {
    /// Where it goes; without it, to standard output
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Writes or prints the template: it loads and runs as it is.
///
/// # Errors
/// There is such a file already, or it cannot be written.
pub fn run(args: Args) -> Result<ExitCode> {
    let template = Installation::find()?.configuration.join("tasks/template.toml");
    match args.out {
        None => {
            print!("{}", std::fs::read_to_string(&template).with_context(|| template.display().to_string())?)
        }
        Some(out) if out.exists() => {
            bail!("{}: there is such a file already; name another one, or remove it", out.display())
        }
        Some(out) => {
            TaskText::read(&template)?.write(&out)?;
            println!("written to {}", out.display());
        }
    }
    Ok(ExitCode::SUCCESS)
}
