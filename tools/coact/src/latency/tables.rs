//! Latencies and deadline misses as tables.

use super::Group;
use coact_monitor::{Figures, Percentiles};
use comfy_table::{CellAlignment, Table, presets::UTF8_FULL_CONDENSED};

/// Cycles and deadline misses, one process a row.
pub(super) fn deadlines(figures: &Figures) -> Table {
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
    for (process, account) in figures.accounts() {
        let percent = 100.0 * account.missed as f64 / account.cycles.max(1) as f64;
        table.add_row([
            process.clone(),
            account.cycles.to_string(),
            account.missed.to_string(),
            format!("{percent:.3} %"),
            account.longest_miss_run.to_string(),
            account.skipped.to_string(),
            account.stale.to_string(),
            account.restarts.to_string(),
        ]);
    }
    table
}

/// Durations in µs, one histogram a row, sort by sort.
pub(super) fn durations(figures: &Figures) -> Table {
    let mut table = table(&["µs", "count", "p50", "p99", "p99.9", "max", "p99.9 corrected"]);
    let histograms = figures.histograms().iter();
    let mut rows: Vec<_> =
        histograms.filter_map(|(name, recorder)| Some((Group::of(name)?, recorder))).collect();
    rows.sort_by(|(a, _), (b, _)| a.cmp(b));
    for ((group, whose), recorder) in rows {
        let raw = Percentiles::of(recorder.total());
        let corrected = Percentiles::of(&recorder.corrected());
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
