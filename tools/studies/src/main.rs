//! The studies of `coact`: its commands that no run needs. `coact` starts this program, and has it built at its first use.

mod bench;
mod carries;
mod completions;
mod evaluate;
mod faults;
mod figures;
mod learn;
mod motion;
mod reaches;
mod replay;
mod separation;
mod task;
mod train;

use clap::{Parser, Subcommand};
use coact::{closed_pipe, program};
use std::process::ExitCode;

/// The studies of coact: commands that no run needs.
#[derive(Parser)]
#[command(name = "coact", bin_name = "coact", version, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

/// What is said of each here stands in `coact::STUDIES` as well.
#[derive(Subcommand)]
enum Command {
    /// Show what is made of a task file
    Task(task::Args),
    /// Learn connections of the network: a plan from demonstrations, what acts show
    Learn(learn::Args),
    /// Measure anticipation on recorded reaches of real people
    Reaches(reaches::Args),
    /// Evaluate whole assemblies with random partners, and compare with ablations
    Evaluate(evaluate::Args),
    /// Measure latencies beside an idle thread and iceoryx2 alone, under load and with kills
    Bench(bench::Args),
    /// Measure the separation of the working robot from recorded people
    Separation(separation::Args),
    /// Break process sets in every way, and judge what happens
    Faults(faults::Args),
    /// Compute a recorded run again, and compare it with the recording to the bit
    Replay(replay::Args),
    /// Draw the chapter's figures from runs made now
    Figures(figures::Args),
    /// Plan a movement of the arm, or measure the planner
    Motion(motion::Args),
    /// Train the model of preshaping from recorded reaches
    Train(train::Args),
    /// Extract the ways of hands that carry, give and withdraw, from motion capture
    Carries(carries::Args),
    /// Print completions for a shell
    Completions(completions::Args),
}

fn main() -> ExitCode {
    program::begin();
    let command = Cli::parse().command;
    // In real time there are processes that this program must stop.
    if !matches!(command, Command::Reaches(_) | Command::Faults(_) | Command::Bench(_)) {
        closed_pipe::ends_the_program();
    }
    program::end(match command {
        Command::Task(args) => task::run(args),
        Command::Learn(args) => learn::run(args),
        Command::Reaches(args) => reaches::run(args),
        Command::Evaluate(args) => evaluate::run(args),
        Command::Bench(args) => bench::run(args),
        Command::Separation(args) => separation::run(args),
        Command::Faults(args) => faults::run(args),
        Command::Replay(args) => replay::run(&args),
        Command::Figures(args) => figures::run(args),
        Command::Motion(args) => motion::run(args),
        Command::Train(args) => train::run(args),
        Command::Carries(args) => carries::run(args),
        Command::Completions(args) => Ok(completions::run(&args)),
    })
}
