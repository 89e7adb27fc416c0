//! `coact task random`: a task that nobody drew.

use anyhow::{Result, bail};
use coact::installation::Installation;
use coact_learning::TaskText;
use coact_random_task::{RandomTask, TaskShape};
use std::path::PathBuf;
use std::process::ExitCode;

/// Arguments of `coact task random`.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  coact task random --seed 7 --out random.toml
  coact task random --seed 8 --subgoals 50 --predecessors 16 --identical 0.33 --out large.toml
  coact task random --seed 9 --choices 0.5 --out alternatives.toml
  coact evaluate --task random.toml --trials 10

The same seed and size give the same task.")]
pub struct Args {
    /// Seed of everything in it
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// How many subgoals it has: 3 to 50
    #[arg(long, value_name = "K", default_value_t = 12)]
    subgoals: usize,
    /// After how many others one of them comes, and none after more: 1 to 16
    #[arg(long, value_name = "M", default_value_t = 3)]
    predecessors: usize,
    /// Share of the subgoals with a part like that of another: 0 to 1
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    identical: f64,
    /// Share of the subgoals that choices offer: of two to four of them, some are enough: 0 to 1
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    choices: f64,
    /// Where it goes; without it, to standard output
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Writes or prints the task.
///
/// # Errors
/// There is no task of that size, there is such a file already, or it cannot be written.
pub fn run(args: Args) -> Result<ExitCode> {
    let shape =
        TaskShape::new(args.subgoals, args.predecessors, args.identical)?.with_choices(args.choices)?;
    let text = RandomTask::new(shape, args.seed).to_toml();
    match args.out {
        None => print!("{text}"),
        Some(out) if out.exists() => {
            bail!("{}: there is such a file already; name another one, or remove it", out.display())
        }
        Some(out) => {
            let shipped = Installation::find()?.configuration.join("tasks/random.toml");
            TaskText::parse(&text, &shipped)?.write(&out)?;
            println!("written to {}", out.display());
        }
    }
    Ok(ExitCode::SUCCESS)
}
