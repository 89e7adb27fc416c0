//! `coact latency`: how regular and how fast a run was, or is.

mod curves;
mod live;
mod tables;

use anyhow::{Context, bail};
use coact_monitor::{Account, Figures, Percentiles};
use serde::Serialize;
use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// What to show.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Report directory of a run (or its folder of .hlog files)
    #[arg(required_unless_present = "live", conflicts_with = "live", value_name = "DIR")]
    directory: Option<PathBuf>,
    /// Attach to a running set and show its figures every second, until Ctrl-C or its end
    #[arg(long)]
    live: bool,
    /// The run to attach to, when several are running; default: the newest
    #[arg(long, value_name = "ID", requires = "live")]
    run: Option<String>,
    /// Print JSON (with --live, one line a second)
    #[arg(long)]
    json: bool,
}

/// The same figures for programs.
#[derive(Debug, Serialize)]
struct Report<'a> {
    processes: BTreeMap<&'a str, Deadlines>,
    /// By the names of the interval logs.
    histograms: BTreeMap<&'a str, Curve>,
}

/// Deadline account of one process.
#[derive(Debug, Serialize)]
struct Deadlines {
    cycles: u64,
    missed: u64,
    longest_miss_run: u64,
    skipped: u64,
    stale: u64,
    restarts: u32,
}

/// One histogram, ns.
#[derive(Debug, Serialize)]
struct Curve {
    raw: Percentiles,
    /// For coordinated omission.
    corrected: Percentiles,
}

impl From<&Account> for Deadlines {
    fn from(account: &Account) -> Self {
        let &Account { cycles, missed, longest_miss_run, skipped, stale, restarts, .. } = account;
        Self { cycles, missed, longest_miss_run, skipped, stale, restarts }
    }
}

/// Shows the figures of a report, or of a running set.
///
/// # Errors
/// There are none, or what is there is damaged.
pub fn run(args: Args) -> anyhow::Result<ExitCode> {
    let Some(directory) = args.directory else {
        live::run(args.run.as_deref(), args.json)?;
        return Ok(ExitCode::SUCCESS);
    };
    let figures = load(&directory)?;
    let text = if args.json { serde_json::to_string_pretty(&report(&figures))? } else { show(&figures) };
    write(&text)?;
    Ok(ExitCode::SUCCESS)
}

/// Writes to standard output; false when its reader has seen enough.
fn write(text: &str) -> anyhow::Result<bool> {
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{}", text.trim_end()).and_then(|()| out.flush()) {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(false),
        Err(error) => Err(error).context("standard output"),
    }
}

fn load(directory: &Path) -> anyhow::Result<Figures> {
    let shown = directory.display();
    if !directory.is_dir() {
        bail!("{shown}: no such directory; expected a report directory of tools/launch");
    }
    let inner = directory.join("latency");
    let folder = if inner.is_dir() { inner.as_path() } else { directory };
    let figures = Figures::load(folder).with_context(|| format!("{shown} cannot be read"))?;
    if figures.histograms().is_empty() {
        bail!("{shown}: holds no latency logs (*.hlog); expected a report directory of tools/launch");
    }
    Ok(figures)
}

fn report(figures: &Figures) -> Report<'_> {
    let histograms = figures.histograms().iter().map(|(name, recorder)| {
        let raw = Percentiles::of(recorder.total());
        (name.as_str(), Curve { raw, corrected: Percentiles::of(&recorder.corrected()) })
    });
    let processes = figures.accounts().iter().map(|(name, account)| (name.as_str(), account.into()));
    Report { processes: processes.collect(), histograms: histograms.collect() }
}

/// Tables and curves as text.
fn show(figures: &Figures) -> String {
    let mut text = format!("{}\n\n{}\n", tables::deadlines(figures), tables::durations(figures));
    for group in [Group::EndToEnd, Group::Hop, Group::WakeUp, Group::Execution] {
        if let Some(curves) = curves::draw(figures, group) {
            text.push_str(&format!("\n{curves}"));
        }
    }
    text
}

/// Sorts of histogram.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Group {
    EndToEnd,
    Hop,
    WakeUp,
    Execution,
}

impl Group {
    /// What a histogram is of, by its log's name: its sort, and of whom.
    fn of(name: &str) -> Option<(Self, String)> {
        let (sort, whose) = name.split_once('.').unwrap_or((name, ""));
        let group = match sort {
            "end-to-end" => Self::EndToEnd,
            "hop" => Self::Hop,
            "wakeup" => Self::WakeUp,
            "execution" => Self::Execution,
            _ => return None,
        };
        Some((group, whose.replace('.', " → ")))
    }

    fn title(self) -> &'static str {
        match self {
            Self::EndToEnd => "end to end (sensor → command)",
            Self::Hop => "hop",
            Self::WakeUp => "wake-up lateness",
            Self::Execution => "execution",
        }
    }
}
