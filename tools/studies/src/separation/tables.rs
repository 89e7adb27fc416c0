//! Encounters as a table, and what they come to.

use super::Separation;
use coact_run_records::SeparationReport;
use comfy_table::{CellAlignment, Table, presets::NOTHING};
use std::path::Path;

/// Prints every encounter, and all together.
pub(super) fn print(separation: &Separation, folder: &Path) {
    let Separation { world, seed, total, encounters } = separation;
    let count = total.encounters;
    println!("{count} encounters with the people of {}, {world} world, seeds from {seed}", folder.display());
    let mut table = Table::new();
    table.load_style(NOTHING);
    table.set_header([
        "recording",
        "arm",
        "seed",
        "nearest mm",
        "margin mm",
        "robot closes ms",
        "person closes ms",
        "contact ms",
        "at most m/s",
        "moved s",
        "held back s",
        "stopped s",
    ]);
    for one in encounters {
        let name = [one.recording.clone(), one.arm.into(), one.seed.to_string()];
        table.add_row(name.into_iter().chain(numbers(&one.separation, one.moved_ms)));
    }
    let name = ["together".into(), String::new(), String::new()];
    table.add_row(name.into_iter().chain(numbers(&total.separation, total.moved_ms)));
    for column in table.column_iter_mut().skip(2) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    println!("{table}");
    println!(
        "the robot moved in {} of {count}; in {} it closed what was nearer than the protective separation; handovers {} ms",
        total.robot_moved, total.robot_closed, total.handover_ms
    );
}

fn numbers(separation: &SeparationReport, moved_ms: u64) -> [String; 9] {
    let seconds = |ms: u64| format!("{:.1}", ms as f64 / 1e3);
    let millimetres =
        |length: Option<f64>| length.map_or("-".into(), |length| format!("{:.0}", 1e3 * length));
    [
        millimetres(separation.nearest_m),
        millimetres(separation.smallest_margin_m),
        separation.robot_closing_ms.to_string(),
        separation.person_closing_ms.to_string(),
        separation.contact_ms.to_string(),
        format!("{:.2}", separation.contact_speed_mps),
        seconds(moved_ms),
        seconds(separation.held_back_ms),
        seconds(separation.stopped_ms),
    ]
}
