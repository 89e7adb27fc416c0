//! `coact learn`: connections of the network, learned from what was seen.

mod mapping;
mod order;

use std::process::ExitCode;

/// Learns connections of the network.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  coact learn order --demonstrations reports/* --out mine.toml
  coact learn mapping --out acts.toml")]
pub struct Args {
    #[command(subcommand)]
    command: Command,
}

#[derive(clap::Subcommand)]
enum Command {
    /// Learn a task's plan from demonstrations, and write a task file that runs
    Order(order::Args),
    /// Learn which act of the person shows which chain, from actions that succeed
    Mapping(mapping::Args),
}

/// Runs the command.
///
/// # Errors
/// A file that is refused, with what was expected.
pub fn run(args: Args) -> anyhow::Result<ExitCode> {
    match args.command {
        Command::Order(args) => order::run(args),
        Command::Mapping(args) => mapping::run(args),
    }
}
