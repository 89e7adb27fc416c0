use super::PlotError;
use crate::{DurationRecorder, INTERVAL_NS};
use hdrhistogram::Histogram;
use plotters::prelude::*;
use std::error::Error;
use std::path::Path;

/// Pixels.
const SIZE: (u32, u32) = (900, 520);
/// Curve of the durations as they were measured.
const RAW: RGBColor = RGBColor(0x1f, 0x5f, 0xa8);
/// Curve of the durations corrected for coordinated omission.
const CORRECTED: RGBColor = RGBColor(0xd0, 0x6a, 0x1c);

/// Draws the percentile curve of a histogram, raw and corrected for coordinated omission, to `path`.
///
/// The axis of percentiles is logarithmic in the fraction of values beyond: 90 %, 99 %, 99.9 % are equally far apart.
///
/// # Errors
/// The file cannot be written.
pub fn percentile_curve(title: &str, recorder: &DurationRecorder, path: &Path) -> Result<(), PlotError> {
    draw(title, recorder.total(), &recorder.corrected(), path).map_err(|cause| PlotError::new(path, cause))
}

/// Points (1 / fraction beyond, duration in µs) of a histogram's curve.
fn points(histogram: &Histogram<u64>) -> Vec<(f64, f64)> {
    let beyond_one = histogram.len() as f64;
    let point =
        |quantile: f64, value_ns: u64| ((1.0 / (1.0 - quantile)).min(beyond_one), value_ns as f64 / 1e3);
    let mut points = vec![(1.0, histogram.min() as f64 / 1e3)];
    points.extend(histogram.iter_quantiles(16).map(|at| point(at.quantile(), at.value_iterated_to())));
    points
}

fn draw(
    title: &str,
    raw: &Histogram<u64>,
    corrected: &Histogram<u64>,
    path: &Path,
) -> Result<(), Box<dyn Error>> {
    let (raw_points, corrected_points) = (points(raw), points(corrected));
    let right = corrected.len().max(100) as f64;
    let highest = corrected.max().max(raw.max()) as f64 / 1e3;
    let area = SVGBackend::new(path, SIZE).into_drawing_area();
    area.fill(&WHITE)?;
    let caption = format!("{title}: {} values", raw.len());
    let mut chart = ChartBuilder::on(&area)
        .caption(caption, ("sans-serif", 22))
        .margin(16)
        .x_label_area_size(48)
        .y_label_area_size(84)
        .build_cartesian_2d((1.0..right).log_scale(), 0.0..(1.05 * highest).max(1.0))?;
    chart
        .configure_mesh()
        .x_desc("percentile")
        .y_desc("duration (µs)")
        .x_label_formatter(&percentile_label)
        .y_label_formatter(&|value| format!("{value:.0}"))
        .light_line_style(WHITE)
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 16))
        .draw()?;
    let corrected_label = format!("corrected for coordinated omission ({} ms)", INTERVAL_NS as f64 / 1e6);
    for (label, points, colour) in
        [(corrected_label.as_str(), corrected_points, CORRECTED), ("raw", raw_points, RAW)]
    {
        chart
            .draw_series(LineSeries::new(points, colour.stroke_width(2)))?
            .label(label)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], colour.stroke_width(2)));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE.mix(0.9))
        .border_style(BLACK.mix(0.3))
        .label_font(("sans-serif", 14))
        .draw()?;
    area.present()?;
    Ok(())
}

/// The percentile beyond which one value in `beyond` lies: 1000 is "99.9 %".
fn percentile_label(beyond: &f64) -> String {
    let nines = beyond.log10().round().max(0.0) as usize;
    format!("{:.*} %", nines.saturating_sub(2), 100.0 - 100.0 / beyond)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_power_of_ten_is_one_more_nine() {
        let labels: Vec<String> = [1.0, 10.0, 100.0, 1e3, 1e5].iter().map(percentile_label).collect();
        assert_eq!(labels, ["0 %", "90 %", "99 %", "99.9 %", "99.999 %"]);
    }

    #[test]
    fn curve_rises_to_the_longest_duration_and_ends_at_the_last_value() {
        let mut recorder = DurationRecorder::default();
        (1..=1000).for_each(|value| recorder.record(value * 1000));
        let points = points(recorder.total());
        assert!(points.is_sorted_by(|a, b| a.0 <= b.0 && a.1 <= b.1), "{points:?}");
        let (beyond, value) = points[points.len() - 1];
        assert!(beyond == 1000.0 && (value - 1000.0).abs() < 1.0, "{beyond} {value}");
    }
}
