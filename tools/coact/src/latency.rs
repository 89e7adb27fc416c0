//! `coact latency`: how punctual and how fast a run was, or is.

mod chart;
mod curves;
mod live;
mod tables;

use anyhow::{Context, bail};
use coact_monitor::{Metrics, ProcessCounters, percentiles};
use coact_run_records::Percentiles;
use serde::Serialize;
use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Shows how punctual and how fast a run was, or is.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact latency reports/long          percentiles and curves of a run that has ended
  coact latency --live                of a running process set, second by second
  coact latency --live --json         the same, one line of JSON a second")]
pub struct Args {
    /// Report directory of a run (or its folder of .hlog files)
    #[arg(required_unless_present = "live", conflicts_with = "live", value_name = "REPORT")]
    directory: Option<PathBuf>,
    /// Attach to a running process set and show its metrics every second, until Ctrl-C or its end
    #[arg(long)]
    live: bool,
    /// The run to attach to, when several are running [default: the newest]
    #[arg(long, value_name = "ID", requires = "live")]
    run: Option<String>,
    /// Print JSON (with --live, one line a second)
    #[arg(long)]
    json: bool,
}

/// The same metrics for programs.
#[derive(Debug, Serialize)]
struct Report<'a> {
    processes: BTreeMap<&'a str, Deadlines>,
    /// By the names of the interval logs.
    histograms: BTreeMap<&'a str, Curve>,
}

/// Cycles and deadline misses of one process.
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

impl From<&ProcessCounters> for Deadlines {
    fn from(counters: &ProcessCounters) -> Self {
        let &ProcessCounters { cycles, missed, longest_miss_run, skipped, stale, restarts, .. } = counters;
        Self { cycles, missed, longest_miss_run, skipped, stale, restarts }
    }
}

/// Shows the metrics of a report, or of a running process set.
///
/// # Errors
/// There are none, or what is there is damaged.
pub fn run(args: Args) -> anyhow::Result<ExitCode> {
    let Some(directory) = args.directory else {
        live::run(args.run.as_deref(), args.json)?;
        return Ok(ExitCode::SUCCESS);
    };
    let metrics = load(&directory)?;
    let text = if args.json { serde_json::to_string_pretty(&report(&metrics))? } else { show(&metrics) };
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

fn load(directory: &Path) -> anyhow::Result<Metrics> {
    let shown = directory.display();
    if !directory.is_dir() {
        bail!("{shown}: no such directory; expected a report directory of tools/launch");
    }
    let inner = directory.join("latency");
    let folder = if inner.is_dir() { inner.as_path() } else { directory };
    let metrics = Metrics::load(folder).with_context(|| format!("{shown} cannot be read"))?;
    if metrics.histograms().is_empty() {
        bail!("{shown}: holds no latency logs (*.hlog); expected a report directory of tools/launch");
    }
    Ok(metrics)
}

fn report(metrics: &Metrics) -> Report<'_> {
    let histograms = metrics.histograms().iter().map(|(name, recorder)| {
        let raw = percentiles(recorder.total());
        (name.as_str(), Curve { raw, corrected: percentiles(&recorder.corrected()) })
    });
    let processes = metrics.counters().iter().map(|(name, counters)| (name.as_str(), counters.into()));
    Report { processes: processes.collect(), histograms: histograms.collect() }
}

/// Tables and curves as text.
fn show(metrics: &Metrics) -> String {
    let mut text = format!("{}\n\n{}\n", tables::deadlines(metrics), tables::durations(metrics));
    for group in [Group::EndToEnd, Group::Hop, Group::WakeUp, Group::Execution] {
        if let Some(curves) = curves::draw(metrics, group) {
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use coact_messages::Pulse;
    use coact_monitor::{Latencies, PipelineNode};
    use std::time::{Duration, SystemTime};

    /// A report of one process, `control`, that is last in the chain and woke up 1 to 100 µs late.
    fn written() -> tempfile::TempDir {
        let report = tempfile::tempdir().unwrap();
        let nodes =
            vec![PipelineNode { process: "control".into(), input_from: Some("fields".into()), last: true }];
        let mut latencies = Latencies::open(
            &report.path().join("latency"),
            nodes,
            Duration::from_millis(50),
            SystemTime::now(),
        )
        .unwrap();
        for cycle in 0..100 {
            let mut pulse = Pulse { scheduled_ns: 5_000_000, input_published_ns: 1, ..Pulse::default() };
            pulse.started_ns = pulse.scheduled_ns + (cycle + 1) * 1000;
            pulse.input_received_ns = 30_001;
            (pulse.header.sequence, pulse.header.sensor_ns) = (cycle, 4_900_000);
            pulse.header.published_ns = 5_200_000;
            latencies.pulse("control", &pulse);
        }
        latencies.write().unwrap();
        report
    }

    fn refused(directory: &Path) -> String {
        format!("{:#}", load(directory).unwrap_err())
    }

    #[test]
    fn report_is_found_by_its_directory_and_by_its_logs() {
        let report = written();
        for directory in [report.path().to_owned(), report.path().join("latency")] {
            let metrics = load(&directory).unwrap();
            assert_eq!(metrics.counters()["control"].cycles, 100);
        }
    }

    #[test]
    fn every_histogram_has_its_row_and_every_sort_its_curves() {
        let metrics = load(written().path()).unwrap();
        let text = show(&metrics);
        for shown in ["hop fields → control", "wake-up lateness control", "execution control", "300.0"] {
            assert!(text.contains(shown), "{shown} is missing in\n{text}");
        }
        assert_eq!(text.matches("duration by percentile").count(), 4);
        assert!(text.contains("99 %") && text.contains("100 µs"), "{text}");
    }

    #[test]
    fn json_has_percentiles_raw_and_corrected() {
        let metrics = load(written().path()).unwrap();
        let json = serde_json::to_value(report(&metrics)).unwrap();
        assert_eq!(json["processes"]["control"]["cycles"], 100);
        assert_eq!(json["histograms"]["end-to-end"]["raw"]["count"], 100);
        assert_eq!(json["histograms"]["wakeup.control"]["corrected"]["count"], 100);
    }

    #[test]
    fn missing_foreign_and_damaged_directories_are_refused_with_their_names() {
        let (report, foreign) = (written(), tempfile::tempdir().unwrap());
        assert!(refused(&foreign.path().join("none")).contains("none: no such directory"));
        assert!(refused(foreign.path()).contains("holds no latency logs"));
        let log = report.path().join("latency/end-to-end.hlog");
        let text = std::fs::read_to_string(&log).unwrap();
        std::fs::write(&log, format!("{text}garbage\n")).unwrap();
        assert!(refused(report.path()).contains("end-to-end.hlog:"), "{}", refused(report.path()));
        std::fs::write(&log, text.replacen("HIST", "XXXX", 1)).unwrap();
        assert!(refused(report.path()).contains("interval 1 is damaged"), "{}", refused(report.path()));
    }
}
