use super::{BLUE, ORANGE, SIZE};
use crate::{Estimate, EvaluationReport};
use coact_monitor::plots::PlotError;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use std::error::Error;
use std::path::Path;

/// A metric of a report.
type Metric = fn(&EvaluationReport) -> Option<Estimate>;

type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// What is drawn, and its name.
const METRICS: [(&str, Metric); 5] = [
    ("human idle", |report| report.human_idle),
    ("robot idle", |report| report.robot_idle),
    ("concurrent", |report| report.concurrent),
    ("functional delay", |report| report.functional_delay),
    ("person waits", |report| report.human_waits),
];

/// Draws the fluency of one network variant, or of two side by side, with their intervals.
///
/// # Errors
/// The file cannot be written.
pub fn draw_fluency(reports: &[(&str, &EvaluationReport)], path: &Path) -> Result<(), PlotError> {
    draw(reports, path).map_err(|cause| PlotError::new(path, cause))
}

fn draw(reports: &[(&str, &EvaluationReport)], path: &Path) -> Result<(), Box<dyn Error>> {
    let all = || reports.iter().flat_map(|(_, report)| METRICS.iter().filter_map(|(_, of)| of(report)));
    let low = all().map(|metric| 100.0 * metric.low).fold(0.0, f64::min);
    let high = all().map(|metric| 100.0 * metric.high).fold(1.0, f64::max);
    let area = SVGBackend::new(path, SIZE).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .caption("Fluency (fraction of the task time, 95 % intervals)", ("sans-serif", 22))
        .margin(16)
        .x_label_area_size(40)
        .y_label_area_size(64)
        .build_cartesian_2d(0.0..METRICS.len() as f64, 1.1 * low..1.1 * high)?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .x_labels(0)
        .y_desc("%")
        .light_line_style(WHITE)
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 16))
        .draw()?;
    for (index, (label, report)) in reports.iter().enumerate() {
        draw_bars(&mut chart, (index, reports.len()), label, report)?;
    }
    for (metric, (name, _)) in METRICS.iter().enumerate() {
        let (x, _) = chart.backend_coord(&(metric as f64 + 0.2, 0.0));
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

/// The bars of one report, number `index` of `all` beside each other, with their intervals.
fn draw_bars(
    chart: &mut Chart<'_, '_>,
    (index, all): (usize, usize),
    label: &str,
    report: &EvaluationReport,
) -> Result<(), Box<dyn Error>> {
    let colour = if index == 0 { BLUE } else { ORANGE };
    let width = 0.7 / all.max(1) as f64;
    let left = |metric: usize| metric as f64 + 0.15 + width * index as f64;
    let shown = || METRICS.iter().enumerate().filter_map(|(at, (_, of))| Some((left(at), of(report)?)));
    let bar = |(x, metric): (f64, Estimate)| {
        Rectangle::new([(x, 0.0), (x + 0.95 * width, 100.0 * metric.value)], colour.filled())
    };
    let whisker = |(x, metric): (f64, Estimate)| {
        let middle = x + 0.475 * width;
        PathElement::new([(middle, 100.0 * metric.low), (middle, 100.0 * metric.high)], BLACK.stroke_width(2))
    };
    chart
        .draw_series(shown().map(bar))?
        .label(label)
        .legend(move |(x, y)| Rectangle::new([(x, y - 5), (x + 14, y + 5)], colour.filled()));
    chart.draw_series(shown().map(whisker))?;
    Ok(())
}
