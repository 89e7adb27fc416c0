//! `coact task`: what a task file says, whether it is sound, and a first one of one's own.

mod check;
mod new;
mod random;
mod show;

use std::process::ExitCode;

/// Shows, checks and begins task files.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  coact task new --out mine.toml
  coact task check mine.toml
  coact task show mine.toml
  coact task random --seed 7 --subgoals 20 --out random.toml")]
pub struct Args {
    #[command(subcommand)]
    command: Command,
}

#[derive(clap::Subcommand)]
enum Command {
    /// Print the populations of all layers and the synapse table that a task file makes
    Show(show::Args),
    /// Explain what is wrong with a task file: parts, subgoals, acts, words, places, decisions
    Check(check::Args),
    /// Write a commented task file to begin with
    New(new::Args),
    /// Write a random task that can be solved, of a given size
    Random(random::Args),
}

/// Runs the command.
///
/// # Errors
/// A task or network file that cannot be read as one, with file, line and key.
pub fn run(args: Args) -> anyhow::Result<ExitCode> {
    match args.command {
        Command::Show(args) => show::run(args),
        Command::Check(args) => check::run(args),
        Command::New(args) => new::run(args),
        Command::Random(args) => random::run(args),
    }
}
