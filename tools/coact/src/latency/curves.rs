//! Percentile curves in the terminal.

use super::Group;
use coact_monitor::Metrics;
use owo_colors::{AnsiColors, OwoColorize, Stream};
use ratatui::buffer::Buffer;
use ratatui::layout::{Constraint, Rect};
use ratatui::style::{Color, Style};
use ratatui::symbols::Marker;
use ratatui::text::Line;
use ratatui::widgets::{Axis, Chart, Dataset, GraphType, LegendPosition, Widget};

/// Size of a chart in characters: a terminal of 100 columns.
const AREA: Rect = Rect { x: 0, y: 0, width: 100, height: 16 };
/// Colours of the curves, told apart on dark and light terminals; after six, the first again.
const COLOURS: [(Color, AnsiColors); 6] = [
    (Color::Cyan, AnsiColors::Cyan),
    (Color::Yellow, AnsiColors::Yellow),
    (Color::Green, AnsiColors::Green),
    (Color::Magenta, AnsiColors::Magenta),
    (Color::Blue, AnsiColors::Blue),
    (Color::Red, AnsiColors::Red),
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
    let datasets = curves.iter().zip(COLOURS.iter().cycle()).map(|((whose, points), (colour, _))| {
        let set = Dataset::default().data(points).marker(Marker::Braille).graph_type(GraphType::Line);
        let set = set.style(Style::default().fg(*colour));
        if whose.is_empty() { set } else { set.name(whose.as_str()) }
    });
    let nines = (0..=right as usize).map(percentile).map(Line::from).collect::<Vec<_>>();
    let decades = (low as i32..=high as i32).map(duration).map(Line::from).collect::<Vec<_>>();
    let chart = Chart::new(datasets.collect())
        .x_axis(Axis::default().bounds([0.0, right]).labels(nines))
        .y_axis(Axis::default().bounds([low, high]).labels(decades))
        .legend_position(Some(LegendPosition::TopLeft))
        .hidden_legend_constraints((Constraint::Min(0), Constraint::Min(0)));
    let mut buffer = Buffer::empty(AREA);
    chart.render(AREA, &mut buffer);
    Some(format!("{}: duration by percentile\n{}", group.title(), text(&buffer)))
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

/// Lines of text, in colour where standard output shows it.
fn text(buffer: &Buffer) -> String {
    let mut text = String::new();
    for y in 0..AREA.height {
        let mut line = String::new();
        for x in 0..AREA.width {
            let cell = &buffer[(x, y)];
            let colour = COLOURS.iter().find(|(own, _)| *own == cell.fg).map(|(_, ansi)| *ansi);
            match colour {
                Some(colour) => {
                    let symbol = cell.symbol();
                    let shown = symbol.if_supports_color(Stream::Stdout, |symbol| symbol.color(colour));
                    line.push_str(&shown.to_string());
                }
                None => line.push_str(cell.symbol()),
            }
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}
