//! Pictures of an evaluation, as SVG.

use crate::{Interval, Report, Trial};
use plotters::prelude::*;
use std::error::Error;
use std::path::{Path, PathBuf};

const SIZE: (u32, u32) = (900, 480);
const ONE: RGBColor = RGBColor(0x1f, 0x5f, 0xa8);
const OTHER: RGBColor = RGBColor(0xd0, 0x6a, 0x1c);
/// Width of a bar of leads, and where leads beyond are gathered, ms.
const STEP: i64 = 25;
const BEYOND: i64 = 1000;

/// A figure of a report.
type Measure = fn(&Report) -> Option<Interval>;

/// A picture could not be drawn or written.
#[derive(Debug, thiserror::Error)]
#[error("{path}: {cause}")]
pub struct PlotError {
    /// Of the picture.
    pub path: PathBuf,
    /// What the drawing library or the system said.
    pub cause: String,
}

impl PlotError {
    fn new(path: &Path, cause: impl std::fmt::Display) -> Self {
        Self { path: path.to_owned(), cause: cause.to_string() }
    }
}

/// Draws how long before grasp completion the right answers to actions in full view were decided; leads beyond 1 s stand at the ends.
///
/// # Errors
/// The file cannot be written.
pub fn draw_leads(trials: &[Trial], path: &Path) -> Result<(), PlotError> {
    let seen = trials.iter().flat_map(|trial| &trial.actions).filter(|action| !action.hidden);
    let leads = seen.filter_map(|action| action.lead_ms);
    leads_to(&leads.collect::<Vec<_>>(), path).map_err(|cause| PlotError::new(path, cause))
}

/// Draws the fluency measures of one mind, or of two side by side, with their intervals.
///
/// # Errors
/// The file cannot be written.
pub fn draw_fluency(reports: &[(&str, &Report)], path: &Path) -> Result<(), PlotError> {
    fluency_to(reports, path).map_err(|cause| PlotError::new(path, cause))
}

fn leads_to(leads: &[i64], path: &Path) -> Result<(), Box<dyn Error>> {
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
        Rectangle::new(corners, if at < 0 { OTHER } else { ONE }.filled())
    });
    chart.draw_series(bars)?;
    area.present()?;
    Ok(())
}

fn fluency_to(reports: &[(&str, &Report)], path: &Path) -> Result<(), Box<dyn Error>> {
    let measures: [(&str, Measure); 5] = [
        ("human idle", |report| report.human_idle),
        ("robot idle", |report| report.robot_idle),
        ("concurrent", |report| report.concurrent),
        ("functional delay", |report| report.functional_delay),
        ("person waits", |report| report.human_waits),
    ];
    let all = || reports.iter().flat_map(|(_, report)| measures.iter().filter_map(|(_, of)| of(report)));
    let low = all().map(|figure| 100.0 * figure.low).fold(0.0, f64::min);
    let high = all().map(|figure| 100.0 * figure.high).fold(1.0, f64::max);
    let area = SVGBackend::new(path, SIZE).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .caption("Fluency (share of the task time, 95 % intervals)", ("sans-serif", 22))
        .margin(16)
        .x_label_area_size(40)
        .y_label_area_size(64)
        .build_cartesian_2d(0.0..measures.len() as f64, 1.1 * low..1.1 * high)?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .x_labels(0)
        .y_desc("%")
        .light_line_style(WHITE)
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 16))
        .draw()?;
    let width = 0.7 / reports.len().max(1) as f64;
    for (place, (label, report)) in reports.iter().enumerate() {
        let colour = if place == 0 { ONE } else { OTHER };
        let left = |measure: usize| measure as f64 + 0.15 + width * place as f64;
        let figures =
            || measures.iter().enumerate().filter_map(|(at, (_, of))| Some((left(at), of(report)?)));
        let bar = |(x, figure): (f64, Interval)| {
            Rectangle::new([(x, 0.0), (x + 0.95 * width, 100.0 * figure.value)], colour.filled())
        };
        let whisker = |(x, figure): (f64, Interval)| {
            let middle = x + 0.475 * width;
            PathElement::new(
                [(middle, 100.0 * figure.low), (middle, 100.0 * figure.high)],
                BLACK.stroke_width(2),
            )
        };
        chart
            .draw_series(figures().map(bar))?
            .label(*label)
            .legend(move |(x, y)| Rectangle::new([(x, y - 5), (x + 14, y + 5)], colour.filled()));
        chart.draw_series(figures().map(whisker))?;
    }
    for (measure, (name, _)) in measures.iter().enumerate() {
        let (x, _) = chart.backend_coord(&(measure as f64 + 0.2, 0.0));
        area.draw_text(name, &("sans-serif", 14).into_font().color(&BLACK), (x, SIZE.1 as i32 - 40))?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .background_style(WHITE.mix(0.9))
        .border_style(BLACK.mix(0.3))
        .label_font(("sans-serif", 14))
        .draw()?;
    area.present()?;
    Ok(())
}
