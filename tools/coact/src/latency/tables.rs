//! Latencies and deadline misses as tables.

use super::Group;
use coact_monitor::{Metrics, percentiles};
use comfy_table::{CellAlignment, Table, presets::UTF8_FULL_CONDENSED};

/// Cycles and deadline misses, one process a row.
pub(super) fn deadlines(metrics: &Metrics) -> Table {
    let mut table = table(&[
        "process",
        "cycles",
        "missed",
        "fraction",
        "longest run",
        "skipped",
        "stale input",
        "restarts",
    ]);
    for (process, counters) in metrics.counters() {
        let percent = 100.0 * counters.missed as f64 / counters.cycles.max(1) as f64;
        table.add_row([
            process.clone(),
            counters.cycles.to_string(),
            counters.missed.to_string(),
            format!("{percent:.3} %"),
            counters.longest_miss_run.to_string(),
            counters.skipped.to_string(),
            counters.stale.to_string(),
            counters.restarts.to_string(),
        ]);
    }
    table
}

/// Durations in µs, one histogram a row, sort by sort.
pub(super) fn durations(metrics: &Metrics) -> Table {
    let mut table = table(&["µs", "count", "p50", "p99", "p99.9", "max", "p99.9 corrected"]);
    let histograms = metrics.histograms().iter();
    let mut rows: Vec<_> =
        histograms.filter_map(|(name, recorder)| Some((Group::of(name)?, recorder))).collect();
    rows.sort_by(|(a, _), (b, _)| a.cmp(b));
    for ((group, whose), recorder) in rows {
        let raw = percentiles(recorder.total());
        let corrected = percentiles(&recorder.corrected());
        let mut row = vec![format!("{} {whose}", group.title()).trim_end().to_owned(), raw.count.to_string()];
        row.extend([raw.p50, raw.p99, raw.p999, raw.max, corrected.p999].map(microseconds));
        table.add_row(row);
    }
    table
}

fn table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED).set_header(header);
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

fn microseconds(ns: u64) -> String {
    format!("{:.1}", ns as f64 / 1e3)
}
