use super::{BLUE, ORANGE, SIZE};
use crate::Trial;
use coact_monitor::plots::PlotError;
use plotters::prelude::{ChartBuilder, Color, IntoDrawingArea, Rectangle, SVGBackend, WHITE};
use std::error::Error;
use std::path::Path;

/// Width of a bar of leads, ms: some forty bars between the leads that occur. Chosen by hand.
const STEP: i64 = 25;
/// Longer leads, and later answers, are in the outermost bars, ms: a reach takes about a second.
const BEYOND: i64 = 1000;

/// Draws how long before grasp completion the right answers to actions in full view were decided;
/// leads beyond 1 s are in the
/// outermost bars.
///
/// # Errors
/// The file cannot be written.
pub fn draw_leads(trials: &[Trial], path: &Path) -> Result<(), PlotError> {
    let seen = trials.iter().flat_map(|trial| &trial.actions).filter(|action| !action.hidden);
    let leads = seen.filter_map(|action| action.lead_ms);
    draw(&leads.collect::<Vec<_>>(), path).map_err(|cause| PlotError::new(path, cause))
}

fn draw(leads: &[i64], path: &Path) -> Result<(), Box<dyn Error>> {
    let bin = |lead: i64| lead.clamp(-BEYOND, BEYOND - 1).div_euclid(STEP);
    let bins = -BEYOND / STEP..BEYOND / STEP;
    let count = |at: i64| leads.iter().filter(|lead| bin(**lead) == at).count();
    let highest = bins.clone().map(count).max().unwrap_or(0).max(1);
    let area = SVGBackend::new(path, SIZE).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .caption(format!("Decision lead: {} answers", leads.len()), ("sans-serif", 22))
        .margin(16)
        .x_label_area_size(48)
        .y_label_area_size(64)
        .build_cartesian_2d(-BEYOND as f64..BEYOND as f64, 0.0..1.05 * highest as f64)?;
    chart
        .configure_mesh()
        .x_desc("decided before grasp completion (ms)")
        .y_desc("actions")
        .x_label_formatter(&|ms| format!("{ms:.0}"))
        .y_label_formatter(&|count| format!("{count:.0}"))
        .light_line_style(WHITE)
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 16))
        .draw()?;
    let bars = bins.map(|at| {
        let corners = [((at * STEP) as f64, 0.0), (((at + 1) * STEP) as f64, count(at) as f64)];
        Rectangle::new(corners, if at < 0 { ORANGE } else { BLUE }.filled())
    });
    chart.draw_series(bars)?;
    area.present()?;
    Ok(())
}
