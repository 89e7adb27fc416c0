use anyhow::Result;
use coact::closed_pipe;
use coact_replay::{Difference, ReplayReport, StageReport, replay};
use std::path::PathBuf;
use std::process::ExitCode;

/// Computes a recorded run again, and compares it with the recording to the bit.
///
/// The recorded sensor samples go through perception and fields, each cycle on the input that it had in the run. Percepts and field
/// frames, with the decision in each, are compared. Commands are not: control's planner answers when it is ready.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact launch --record --report reports/mine    records a run
  coact replay reports/mine/run.mcap             computes it again
  coact replay reports/mine/run.mcap --json      for a machine

Exit status: 0 all that was compared is equal, 1 something differs, 2 bad usage or file.")]
pub struct Args {
    /// The recording: run.mcap, or run-2.mcap of a recorder that was restarted
    #[arg(value_name = "FILE")]
    recording: PathBuf,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

/// Replays a recording.
///
/// # Errors
/// It cannot be read, or holds nothing that can be compared.
pub fn run(args: &Args) -> Result<ExitCode> {
    let report = replay(&args.recording)?;
    closed_pipe::ends_the_program();
    match args.json {
        true => println!("{}", serde_json::to_string_pretty(&report)?),
        false => print!("{}", text(&report)),
    }
    Ok(if report.equal { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The report in words.
fn text(report: &ReplayReport) -> String {
    let mut lines = Vec::new();
    if let Some((first, last)) = report.cycles {
        lines.push(format!("samples     of cycles {first} to {last}"));
    }
    lines.push(stage("percepts", &report.percepts));
    lines.push(stage("frames", &report.frames));
    lines.push(format!("decisions   {} in the frames that were compared", report.decisions));
    lines.push("commands    not compared: control's planner answers when it is ready".to_owned());
    lines.push(format!("lost        {}", lost(report)));
    if report.truncated {
        lines.push("the file ends in the middle: read up to there".to_owned());
    }
    if !report.same_code {
        let version = &report.version;
        lines.push(format!("recorded by other code (version {version}): what differs may come from that"));
    }
    let differences = [&report.percepts, &report.frames].map(|stage| stage.first_difference.as_ref());
    lines.extend(differences.into_iter().flatten().map(difference));
    lines.push(if report.equal { "equal to the bit" } else { "different" }.to_owned());
    lines.join("\n") + "\n"
}

fn stage(name: &str, report: &StageReport) -> String {
    let StageReport { computed, compared, differing, not_compared, resumed, .. } = report;
    let mut line = format!("{name:<12}{compared} compared of {computed} computed, {differing} differ");
    if *not_compared > 0 {
        line += &format!(
            "; {not_compared} recorded ones not compared, where what they were computed on is not recorded"
        );
    }
    if *resumed > 0 {
        line += &format!("; went on from a recorded one {resumed} times");
    }
    line
}

fn lost(report: &ReplayReport) -> String {
    match &report.lost {
        None => "unknown: the recorder wrote no end".to_owned(),
        Some(lost) if lost.is_empty() => "no message, by the recorder's count".to_owned(),
        Some(lost) => {
            lost.iter().map(|(topic, count)| format!("{count} of {topic}")).collect::<Vec<_>>().join(", ")
        }
    }
}

fn difference(found: &Difference) -> String {
    let Difference { topic, cycle, generation, sequence, field, byte } = found;
    format!(
        "first difference on {topic}: cycle {cycle} (message {sequence}, generation {generation}): {field}, byte {byte}"
    )
}
