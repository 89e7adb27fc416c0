//! The operator's command line: what starts, watches and reports runs. Whatever no run needs is a study, and belongs to a
//! second program, `coact-studies`, so that the first `tools/launch` need not wait until that is built.

mod adopt;
mod check;
/// Readers who have seen enough.
pub mod closed_pipe;
mod companion;
mod console;
/// The hand of a partner from outside.
pub mod hand;
mod inject;
/// Where programs, configuration and data are.
pub mod installation;
mod latency;
mod launch;
mod living_runs;
mod lockstep;
mod operator_stop;
/// The setting of a partner.
pub mod partner;
/// How a program ends.
pub mod program;
pub mod report_folder;
mod run_report;
mod say;
mod snapshots;
mod studies;
mod why;

use anyhow::Result;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use std::ffi::OsString;
use std::process::ExitCode;
pub use studies::STUDIES;

/// A robot that builds together with a person.
///
/// Every command has --help with examples.
#[derive(Parser)]
#[command(name = "coact", version, max_term_width = 100)]
#[command(after_help = "Examples:
  coact launch                          a robot and a simulated partner build a toy vehicle
  coact task check mine.toml            what is wrong with a task of one's own
  coact completions bash                what makes the shell complete all this")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Start the process set, watch it build, and report
    Launch(launch::Args),
    /// Take over a run whose supervisor has died
    Adopt(adopt::Args),
    /// Say whether this machine can hold a period of 1 ms, and what would help
    Check(check::Args),
    /// Stop the robot of a running process set: it brakes, and stands until resume
    ///
    /// The stop belongs to the set, not to this terminal: it outlasts whatever ends or dies, except the set itself.
    #[command(after_help = "Examples:\n  coact stop\n  coact stop --run 1a2b-0")]
    Stop(operator_stop::Args),
    /// Let the robot of a running process set go on after stop
    #[command(after_help = "Examples:\n  coact resume\n  coact resume --run 1a2b-0")]
    Resume(operator_stop::Args),
    /// Inject a fault into a process of a running process set
    Inject(inject::Args),
    /// Say something to the robot of a running process set
    Say(say::Args),
    /// Ask the robot of a running process set why it does what it does
    Why(why::Args),
    /// Move the hand of a running process set's partner, as lines on standard input say
    ///
    /// Each line is a JSON array of numbers, and moves the hand when it comes: some 60 a second, at most 250. When none has come
    /// for 100 ms, the robot does not see the hand any more. Lengths are in m, in the world frame of the task file.
    ///
    /// 27 numbers: x, y, z of shoulder, elbow, wrist, palm base, thumb tip, index knuckle, index tip, middle tip and
    /// little-finger knuckle of the right arm.
    ///
    /// 5 numbers: x, y, z of the middle between thumb tip and index tip, the hand's pitch in degrees (-90: it points straight
    /// down, 0: it lies flat), and the distance of the two tips; arm and hand are then those of an adult at the person's place.
    ///
    /// Fingers that close around a part take it: they are 16 mm farther apart then than it is wide. Fingers that open let it
    /// go. An open hand that is held out, flat, where parts change hands asks for one.
    Hand(hand::Args),
    /// Show a recorded run in the browser
    Console(console::Args),
    /// Show how punctual and how fast a run was, or is
    Latency(latency::Args),
    /// Draw a run's snapshots: pictures of who took what
    Snapshots(snapshots::Args),
}

/// The command line with all commands; of the studies only names and descriptions.
pub fn command_line() -> clap::Command {
    let study = |(name, about): (&'static str, &'static str)| clap::Command::new(name).about(about);
    Cli::command().subcommands(STUDIES.map(study))
}

/// The program `coact`, from its arguments to its exit status.
pub fn run_program() -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    program::begin();
    program::end(run(&arguments))
}

fn run(arguments: &[OsString]) -> Result<ExitCode> {
    if studies::are_meant(arguments) {
        return Err(studies::run(arguments));
    }
    let matches = command_line().get_matches();
    let command = Cli::from_arg_matches(&matches).unwrap_or_else(|error| error.exit()).command;
    match command {
        Command::Launch(args) => launch::run(args),
        Command::Adopt(args) => adopt::run(args),
        Command::Check(args) => check::run(args),
        Command::Stop(args) => operator_stop::stop(&args),
        Command::Resume(args) => operator_stop::resume(&args),
        Command::Inject(args) => inject::run(args),
        Command::Say(args) => say::run(args),
        Command::Why(args) => why::run(args),
        Command::Hand(args) => hand::run(args),
        Command::Console(args) => console::run(args),
        Command::Latency(args) => latency::run(args),
        Command::Snapshots(args) => snapshots::run(args),
    }
}
