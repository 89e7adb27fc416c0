use crate::installation::Installation;
use anyhow::Result;
use coact_machine_check::{Demand, Finding, Level, check};
use coact_pipeline::Pipeline;
use owo_colors::{OwoColorize, Stream};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Says whether this machine can hold a period of 1 ms, and what would help.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact check             what suits, what does not, what to do
  coact check --json      the same for a program

Green: as it should be. Yellow: cycles will be late now and then. Red: the period will not be held.
Exit status: 0 nothing is red, 1 something is, 2 bad usage or configuration.")]
pub struct Args {
    /// The process table, for its cores and priorities [default: rt-config/pipeline.toml]
    #[arg(long, value_name = "FILE")]
    pipeline: Option<PathBuf>,
    /// Print what was found as JSON
    #[arg(long)]
    json: bool,
}

/// Judges this machine.
///
/// # Errors
/// The process table cannot be read.
pub fn run(args: Args) -> Result<ExitCode> {
    let shipped = || Installation::find().map(|found| found.configuration.join("pipeline.toml"));
    let table = args.pipeline.map_or_else(shipped, Ok)?;
    let findings = check(Path::new("/"), &demand(&Pipeline::load(&table)?));
    match args.json {
        true => println!("{}", serde_json::to_string_pretty(&findings)?),
        false => findings.iter().for_each(|finding| println!("{}", line(finding))),
    }
    let red = findings.iter().any(|finding| finding.level == Level::Red);
    Ok(if red { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

fn demand(pipeline: &Pipeline) -> Demand {
    let realtime = || pipeline.processes.iter().filter(|entry| entry.realtime);
    let mut cores: Vec<usize> = realtime().filter_map(|entry| entry.core).collect();
    cores.sort_unstable();
    cores.dedup();
    Demand { cores, priority: realtime().map(|entry| entry.priority).max().unwrap_or(0) }
}

fn line(finding: &Finding) -> String {
    let Finding { subject, level, found, expected, remedy } = finding;
    let level = match level {
        Level::Green => "green ".if_supports_color(Stream::Stdout, |text| text.green()).to_string(),
        Level::Yellow => "yellow".if_supports_color(Stream::Stdout, |text| text.yellow()).to_string(),
        Level::Red => "red   ".if_supports_color(Stream::Stdout, |text| text.red()).to_string(),
    };
    let advice = remedy.map_or(String::new(), |remedy| {
        format!("\n        {:<18}expected: {expected}\n        {:<18}to do: {remedy}", "", "")
    });
    format!("{level}  {subject:<18}{found}{advice}")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn the_demand_is_that_of_the_real_time_processes() {
        let table = "[[process]]\nname = \"a\"\nprogram = \"a\"\norder = 1\nrealtime = true\npriority = 83\ncore = 1\n\
                     [[process]]\nname = \"b\"\nprogram = \"b\"\norder = 1\nrealtime = true\npriority = 81\ncore = 1\n\
                     [[process]]\nname = \"c\"\nprogram = \"c\"\norder = 1\n";
        let pipeline = Pipeline::parse(table, "table".as_ref()).unwrap();
        assert_eq!(demand(&pipeline), Demand { cores: vec![1], priority: 83 });
    }

    #[test]
    fn what_is_not_green_says_what_is_expected_and_what_to_do() {
        let finding = |level, remedy| Finding {
            subject: "cores",
            level,
            found: "1".into(),
            expected: "at least 2",
            remedy,
        };
        let red = line(&finding(Level::Red, Some("use more")));
        assert!(red.contains("expected: at least 2") && red.contains("to do: use more"), "{red}");
        assert!(!line(&finding(Level::Green, None)).contains("expected"));
    }
}
