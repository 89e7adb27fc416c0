//! Percentile curves in the terminal.

use super::Group;
use super::chart::Chart;
use coact_monitor::Metrics;
use owo_colors::AnsiColors;

/// Colours of the curves, told apart on dark and light terminals; after six, the first again.
const COLOURS: [AnsiColors; 6] = [
    AnsiColors::Cyan,
    AnsiColors::Yellow,
    AnsiColors::Green,
    AnsiColors::Magenta,
    AnsiColors::Blue,
    AnsiColors::Red,
];

/// All histograms of one sort in one chart; none when there are no values.
///
/// Both axes are logarithmic: to the right each further nine of the percentile, upwards powers of ten.
pub(super) fn draw(metrics: &Metrics, group: Group) -> Option<String> {
    let mut curves = Vec::new();
    for (name, recorder) in metrics.histograms() {
        match Group::of(name) {
            Some((own, whose)) if own == group && !recorder.total().is_empty() => {
                curves.push((whose, points(recorder.total())));
            }
            _ => {}
        }
    }
    let all = || curves.iter().flat_map(|(_, points)| points);
    let right = all().map(|point| point.0).fold(2.0, f64::max).ceil();
    let (low, high) = all().fold((f64::MAX, f64::MIN), |(low, high), &(_, y)| (low.min(y), high.max(y)));
    if curves.is_empty() {
        return None;
    }
    let (low, high) = (low.floor(), high.ceil().max(low.floor() + 1.0));
    let nines: Vec<_> = (0..=right as usize).map(percentile).collect();
    let decades: Vec<_> = (low as i32..=high as i32).map(duration).collect();
    let mut chart = Chart::new(&nines, &decades);
    for ((_, points), colour) in curves.iter().zip(COLOURS.iter().cycle()) {
        let fractions: Vec<_> = points.iter().map(|(x, y)| (x / right, (y - low) / (high - low))).collect();
        chart.curve(&fractions, *colour);
    }
    chart.legend(curves.iter().map(|(whose, _)| whose.as_str()).zip(COLOURS.into_iter().cycle()));
    Some(format!("{}: duration by percentile\n{}", group.title(), chart.text()))
}

/// Points (nines of the percentile, power of ten of the duration in µs).
fn points(histogram: &hdrhistogram::Histogram<u64>) -> Vec<(f64, f64)> {
    let last = (histogram.len() as f64).log10();
    let mut points: Vec<(f64, f64)> = Vec::new();
    for at in histogram.iter_quantiles(8) {
        let nines = (-(1.0 - at.quantile()).log10()).min(last).max(0.0);
        let decade = (at.value_iterated_to().max(1) as f64 / 1e3).log10();
        points.push((nines, decade));
    }
    points
}

fn percentile(nines: usize) -> String {
    format!("{:.*} %", nines.saturating_sub(2), 100.0 - 100.0 / 10_f64.powi(nines as i32))
}

fn duration(decade: i32) -> String {
    match decade {
        ..0 => format!("{} ns", 10_f64.powi(decade + 3)),
        0..3 => format!("{} µs", 10_f64.powi(decade)),
        3..6 => format!("{} ms", 10_f64.powi(decade - 3)),
        _ => format!("{} s", 10_f64.powi(decade - 6)),
    }
}
