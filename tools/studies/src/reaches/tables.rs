//! Anticipation as a table: one person, then one kind of reach, a row.

use super::Measured;
use super::real_time::RealTimeMetrics;
use coact_reaches::{FIRST, ReachTally};
use comfy_table::{CellAlignment, Table, presets};

const COLUMNS: [&str; 14] = [
    "of",
    "reaches",
    "right",
    "wrong",
    "none",
    "20 %",
    "40 %",
    "60 %",
    "80 %",
    "100 %",
    "goal lead p5 p50 p95",
    "answered",
    "answer lead p5 p50 p95",
    "onset p5 p50 p95",
];

/// Prints what was decided under one plan; `unseen` says whose reaches the model comes from.
pub(super) fn print(measured: &Measured, unseen: &str) {
    let Measured { report, real_time } = measured;
    let ReachTally { reaches, .. } = report.overall;
    println!("\n{}: {} goals possible, {reaches} reaches, {unseen}", report.task, report.goals);
    let mut table = Table::new();
    table.load_style(presets::UTF8_HORIZONTAL_ONLY).set_header(COLUMNS);
    for (person, tally) in &report.people {
        table.add_row(row(&format!("p{person}"), tally));
    }
    table.add_row(row("all", &report.overall));
    table.add_row(row(&format!("first {FIRST} each"), &report.first));
    for (width, tally) in &report.widths {
        table.add_row(row(&format!("{:.0} mm wide", 1e3 * width), tally));
    }
    table.column_iter_mut().skip(1).for_each(|column| column.set_cell_alignment(CellAlignment::Right));
    println!("{table}");
    println!(
        "right: goal decided before contact (IL), of all reaches. 20 % ...: right goal standing at that part of movement time.\n\
         answered: right action decided before contact (AEL). lead: contact minus it, ms. onset: perception's\n\
         minus the label, ms."
    );
    for RealTimeMetrics { participant, cycles, missed, end_to_end_p99_ns, report, .. } in real_time {
        println!(
            "p{participant} in real time: {cycles} cycles, {missed} missed by any process, end to end p99 {} µs; {}",
            end_to_end_p99_ns / 1000,
            report.display()
        );
    }
}

fn row(name: &str, tally: &ReachTally) -> Vec<String> {
    let percent = |fraction: f64| format!("{:.1} %", 100.0 * fraction);
    let spread = |values: Option<[i64; 3]>| values.map_or("-".into(), |[a, b, c]| format!("{a} {b} {c}"));
    let mut cells = vec![name.to_owned(), tally.reaches.to_string(), percent(tally.right_fraction)];
    cells.extend([tally.wrong.to_string(), tally.undecided.to_string()]);
    cells.extend(tally.right_during_reach.map(percent));
    cells.push(spread(tally.lead_ms));
    cells.extend([percent(tally.answered_fraction), spread(tally.answer_lead_ms), spread(tally.onset_ms)]);
    cells
}
