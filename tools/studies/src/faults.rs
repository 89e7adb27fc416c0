//! `coact faults`: what happens when something breaks, and whether the robot stays safe.

use anyhow::{Context, Result, ensure};
use coact::installation::Installation;
use coact_faults::{Campaign, Cell, MatrixReport, Moment, Outcome, Selection, Setup, Step, matrix, page};
use coact_pipeline::WorldMode;
use comfy_table::{Table, presets::UTF8_HORIZONTAL_ONLY};
use owo_colors::{OwoColorize, Stream};
use signal_hook::consts::{SIGINT, SIGTERM};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// Breaks real process sets in every way, at every moment, and judges each by what the run left.
#[derive(Debug, clap::Args)]
#[command(after_help = after_help())]
pub struct Args {
    /// Each fault where it is worst, within four minutes
    #[arg(long)]
    quick: bool,
    /// These cells only, with commas between: TARGET:FAULT@MOMENT, parts of which may be left out
    #[arg(long, value_name = "CELLS", value_delimiter = ',')]
    only: Vec<Selection>,
    /// Begin no run after so many minutes; what was not done is unknown
    #[arg(long, value_name = "M")]
    minutes: Option<f64>,
    /// Seed of every run
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// How the world computes: kinematic, or physics
    #[arg(long, default_value = "kinematic")]
    world: WorldMode,
    /// Fail also when this machine took longer than allowed to recover
    #[arg(long)]
    strict: bool,
    /// Print one JSON document instead of the table
    #[arg(long)]
    json: bool,
    /// Write faults.html and faults.json to this folder, and what runs left in which not all was green
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// After this time the quick part begins no run any more: what is left of its four minutes is enough to end one.
const QUICK: Duration = Duration::from_secs(200);

fn after_help() -> String {
    let examples = "Examples:
  coact faults --quick                     four minutes
  coact faults --only kill@moving          SIGKILL of each process while the arm moves
  coact faults --only control:,@shutdown   all of control, and all at the end of a run
  coact faults --out reports/faults        the whole matrix, as a page; about two hours
  coact faults --minutes 30                as much of it as half an hour allows

Ctrl-C ends it after the present run, with all that was judged by then.";
    let not_covered = matrix::NOT_COVERED.map(|(fault, why)| format!("\n  {fault}: {why}")).concat();
    format!(
        "{examples}\n\nNot covered yet:{not_covered}\n\nExit status: 0 all green or late (with --strict: green), 1 when a cell is red or unknown, 2 bad usage or configuration."
    )
}

/// Does the cells and shows what became of them.
///
/// # Errors
/// The configuration is refused, or the folder cannot be written to.
pub fn run(args: Args) -> Result<ExitCode> {
    let Installation { programs, configuration, .. } = Installation::find()?;
    let coact = programs.join("coact");
    ensure!(coact.is_file(), "{}: there is no such program; expected it beside this one", coact.display());
    if let Some(out) = &args.out {
        std::fs::create_dir_all(out)
            .with_context(|| format!("--out {}: expected a folder that can be written to", out.display()))?;
    }
    let mut setup = Setup::load(coact, &configuration, args.seed, args.world)?;
    if let Some(out) = &args.out {
        setup = setup.keeping(std::path::absolute(out)?);
    }
    let begin = Instant::now();
    let interrupted = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        signal_hook::flag::register(signal, Arc::clone(&interrupted))?;
    }
    let campaign = Campaign::new(&setup, limit(&args)?.map(|limit| begin + limit), &interrupted);
    let judged = campaign.run(cells(&args)?, &mut show);
    let report = MatrixReport::new(judged, begin.elapsed().as_secs_f64());
    let json = serde_json::to_string_pretty(&report)?;
    if let Some(out) = &args.out {
        for (name, text) in [("faults.html", &page(&report)), ("faults.json", &json)] {
            let path = out.join(name);
            std::fs::write(&path, text).with_context(|| format!("{}: cannot be written", path.display()))?;
        }
    }
    println!("{}", if args.json { json } else { text(&report) });
    Ok(if report.passes(args.strict) { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// How long runs are begun.
fn limit(args: &Args) -> Result<Option<Duration>> {
    let Some(minutes) = args.minutes else { return Ok(args.quick.then_some(QUICK)) };
    let limit = Duration::try_from_secs_f64(60.0 * minutes).ok().filter(|limit| !limit.is_zero());
    limit.map(Some).with_context(|| format!("--minutes {minutes}: expected minutes above 0, for example 30"))
}

fn cells(args: &Args) -> Result<Vec<Cell>> {
    let all = if args.quick { matrix::quick() } else { matrix::whole() };
    let is_meant = |cell: &Cell| args.only.is_empty() || args.only.iter().any(|only| only.selects(cell));
    let cells: Vec<_> = all.into_iter().filter(is_meant).collect();
    ensure!(!cells.is_empty(), "--only selects no cell of the quick part; expected --only without --quick");
    Ok(cells)
}

fn show(step: Step<'_>) {
    let names = |cells: &[Cell]| cells.iter().map(Cell::to_string).collect::<Vec<_>>().join(", ");
    match step {
        Step::Run(cells, left) => eprintln!("run: {}; {left} left after it", names(cells)),
        Step::Again(cells) => eprintln!("again, in two runs: {}", names(cells)),
        Step::Judged(judged) => eprintln!("  {} {}", judged.cell, word(&judged.outcome)),
    }
}

fn word(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Green => "green".if_supports_color(Stream::Stderr, |text| text.green()).to_string(),
        Outcome::Late(_) => "late".if_supports_color(Stream::Stderr, |text| text.yellow()).to_string(),
        Outcome::Red(_) => "red".if_supports_color(Stream::Stderr, |text| text.red()).to_string(),
        Outcome::Unknown(_) => {
            "unknown".if_supports_color(Stream::Stderr, |text| text.bright_black()).to_string()
        }
    }
}

/// The table, and below it the reasons of all that is not green.
fn text(report: &MatrixReport) -> String {
    let mut table = Table::new();
    table.load_style(UTF8_HORIZONTAL_ONLY);
    table.set_header(["fault", "target"].into_iter().chain(Moment::ALL.map(Moment::name)));
    for row in report.rows() {
        let outcomes = row.outcomes.map(|outcome| outcome.map_or_else(String::new, word));
        table.add_row([row.fault, row.target].into_iter().chain(outcomes));
    }
    let [green, late, red, unknown] = report.counts();
    let mut text = format!("{table}\n");
    for judged in &report.cells {
        let reasons = match &judged.outcome {
            Outcome::Green => continue,
            Outcome::Red(reasons) | Outcome::Late(reasons) => reasons.join("\n    "),
            Outcome::Unknown(reason) => reason.clone(),
        };
        text += &format!("\n{} {}\n    {reasons}", judged.cell, word(&judged.outcome));
    }
    let missing = report.not_covered.iter().map(|(fault, _)| *fault).collect::<Vec<_>>().join("; ");
    format!(
        "{text}\n\n{green} green, {late} late, {red} red, {unknown} unknown, in {:.0} s\nnot covered yet: {missing}",
        report.duration_s
    )
}
