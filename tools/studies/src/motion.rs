//! `coact motion`: movements of the arm, planned without a process set.

mod bench;
mod plan;
mod robot;

use anyhow::Result;
use std::process::ExitCode;

/// Plans movements of arm and hand.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact motion plan --to=-0.4,0.55,0.83 --out motion
  coact motion bench")]
pub struct Args {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, clap::Subcommand)]
enum Command {
    /// Plan one movement, draw it and write it down
    Plan(plan::Args),
    /// Measure the planner on randomised movements
    Bench(bench::Args),
}

/// Runs the subcommand.
///
/// # Errors
/// Those of the subcommand.
pub fn run(args: Args) -> Result<ExitCode> {
    match args.command {
        Command::Plan(args) => plan::run(args),
        Command::Bench(args) => bench::run(args),
    }
}
