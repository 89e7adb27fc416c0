//! The operator's command line.

mod closed_pipe;
mod completions;
mod evaluate;
mod figures;
mod inject;
mod installation;
mod latency;
mod launch;
mod learn;
mod living_runs;
mod lockstep;
mod motion;
mod partner;
mod reaches;
mod report_folder;
mod run_report;
mod say;
mod snapshots;
mod task;
mod train;

use clap::{Parser, Subcommand};
use owo_colors::{OwoColorize, Stream};
use std::process::ExitCode;

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
    /// Inject a fault into a process of a running process set
    Inject(inject::Args),
    /// Say something to the robot of a running process set
    Say(say::Args),
    /// Show how punctual and how fast a run was, or is
    Latency(latency::Args),
    /// Draw a run's snapshots: pictures of who took what
    Snapshots(snapshots::Args),
    /// Show what is made of a task file
    Task(task::Args),
    /// Learn connections of the network: a plan from demonstrations, what acts show
    Learn(learn::Args),
    /// Measure anticipation on recorded reaches of real people
    Reaches(reaches::Args),
    /// Evaluate whole assemblies with random partners, and compare with ablations
    Evaluate(evaluate::Args),
    /// Draw the chapter's figures from runs made now
    Figures(figures::Args),
    /// Plan a movement of the arm, or measure the planner
    Motion(motion::Args),
    /// Train the model of preshaping from recorded reaches
    Train(train::Args),
    /// Print completions for a shell
    Completions(completions::Args),
}

/// Bad usage, configuration or input.
const REFUSED: u8 = 2;

/// Whether a command neither starts processes nor speaks with running ones.
fn works_on_files_alone(command: &Command) -> bool {
    use Command::{Completions, Evaluate, Figures, Learn, Motion, Snapshots, Task, Train};
    matches!(
        command,
        Completions(_) | Evaluate(_) | Figures(_) | Learn(_) | Motion(_) | Snapshots(_) | Task(_) | Train(_)
    )
}

fn main() -> ExitCode {
    tracing_subscriber::fmt()
        .with_writer(std::io::stderr)
        .with_env_filter(
            tracing_subscriber::EnvFilter::builder()
                .with_default_directive(tracing::Level::WARN.into())
                .from_env_lossy(),
        )
        .without_time()
        .with_target(false)
        .init();
    let command = Cli::parse().command;
    if works_on_files_alone(&command) {
        closed_pipe::ends_the_program();
    }
    let outcome = match command {
        Command::Launch(args) => launch::run(args),
        Command::Inject(args) => inject::run(args),
        Command::Say(args) => say::run(args),
        Command::Latency(args) => latency::run(args),
        Command::Snapshots(args) => snapshots::run(args),
        Command::Task(args) => task::run(args),
        Command::Learn(args) => learn::run(args),
        Command::Reaches(args) => reaches::run(args),
        Command::Evaluate(args) => evaluate::run(args),
        Command::Figures(args) => figures::run(args),
        Command::Motion(args) => motion::run(args),
        Command::Train(args) => train::run(args),
        Command::Completions(args) => Ok(completions::run(&args)),
    };
    outcome.unwrap_or_else(|error| {
        eprintln!("{} {error:#}", "error:".if_supports_color(Stream::Stderr, |text| text.red()));
        ExitCode::from(REFUSED)
    })
}
