use super::PlotError;
use coact_run_records::ActionEvent;
use plotters::prelude::*;
use std::error::Error;
use std::path::Path;

/// Width of the picture, pixels.
const WIDTH: u32 = 1000;
/// Height of a row, pixels: a line of text.
const ROW: u32 = 22;
/// Height of caption, axis and margins, pixels.
const FRAME: u32 = 150;
/// Later actions are left out of the picture, not out of the summary: nobody reads a longer one. Chosen by hand.
const MOST_ROWS: usize = 120;
/// The bar from reach onset to grasp completion.
const REACH: RGBColor = RGBColor(0x9d, 0xb4, 0xcc);
/// The point of a right decision.
const RIGHT: RGBColor = RGBColor(0x1b, 0x8a, 0x3a);
/// The point of a wrong one.
const WRONG: RGBColor = RGBColor(0xc6, 0x28, 0x28);

/// Draws for each of the partner's actions one row, from reach onset to grasp completion, with the decision on it.
///
/// # Errors
/// The file cannot be written.
pub fn anticipation_timeline(actions: &[ActionEvent], path: &Path) -> Result<(), PlotError> {
    let shown = &actions[..actions.len().min(MOST_ROWS)];
    draw(shown, actions.len(), path).map_err(|cause| PlotError::new(path, cause))
}

fn draw(shown: &[ActionEvent], all: usize, path: &Path) -> Result<(), Box<dyn Error>> {
    let rows = shown.len().max(1);
    let size = (WIDTH, FRAME + ROW * rows as u32);
    let area = SVGBackend::new(path, size).into_drawing_area();
    area.fill(&WHITE)?;
    let span = span(shown);
    let mut chart = ChartBuilder::on(&area)
        .caption(caption(shown.len(), all), ("sans-serif", 20))
        .margin(16)
        .margin_right(28)
        .x_label_area_size(48)
        .y_label_area_size(330)
        .build_cartesian_2d(span.clone(), (rows as f64 - 0.5)..-0.5)?;
    chart
        .configure_mesh()
        .x_desc("time from grasp completion (ms)")
        .x_label_formatter(&|ms| format!("{ms:.0}"))
        .y_labels(0)
        .disable_y_mesh()
        .light_line_style(WHITE)
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 16))
        .draw()?;
    chart.draw_series([PathElement::new([(0.0, -0.5), (0.0, rows as f64 - 0.5)], BLACK.stroke_width(1))])?;
    for (row, action) in shown.iter().enumerate() {
        let (y, grasp) = (row as f64, action.grasp_ms as f64);
        let onset = action.onset_ms as f64 - grasp;
        chart.draw_series([Rectangle::new([(onset, y - 0.3), (0.0, y + 0.3)], REACH.filled())])?;
        if let Some(decided) = action.decided_ms {
            let colour = if action.correct { RIGHT } else { WRONG };
            let at = (decided as f64 - grasp).clamp(span.start, span.end);
            chart.draw_series([Circle::new((at, y), 5, colour.filled())])?;
        }
        let (_, pixel) = chart.backend_coord(&(0.0, y));
        let style = ("sans-serif", 13).into_font().color(&BLACK);
        area.draw_text(&label(action), &style, (20, pixel - 7))?;
    }
    area.present()?;
    Ok(())
}

fn caption(shown: usize, all: usize) -> String {
    let part = if shown < all { format!(" (the first {shown} of {all})") } else { String::new() };
    format!("Partner's actions{part}: bar = reach, green = right decision, red = wrong")
}

fn label(action: &ActionEvent) -> String {
    let ActionEvent { chain, subgoal, grasp_ms, .. } = action;
    let text = format!("{:.1} s  {chain}: {subgoal}", *grasp_ms as f64 / 1e3);
    match text.char_indices().nth(48) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

/// What the axis of time must show, ms: all reaches, and decisions unless they are further away than a reach.
fn span(shown: &[ActionEvent]) -> std::ops::Range<f64> {
    let relative = |ms: u64, action: &ActionEvent| ms as f64 - action.grasp_ms as f64;
    let onsets = shown.iter().map(|action| relative(action.onset_ms, action));
    let first = onsets.fold(-100.0, f64::min);
    let decisions =
        shown.iter().filter_map(|action| Some(relative(action.decided_ms?, action))).collect::<Vec<_>>();
    let left = decisions.iter().copied().fold(first, f64::min).max(2.0 * first);
    let right = decisions.iter().copied().fold(0.0, f64::max).min(-first);
    1.05 * left..1.05 * right + 50.0
}
