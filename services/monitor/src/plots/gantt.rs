use super::PlotError;
use coact_run_records::{Occupation, TimelineSpan, Waiting};
use plotters::prelude::*;
use std::error::Error;
use std::path::Path;

/// Width of the picture, pixels.
const WIDTH: u32 = 1400;
/// Height of a row of time: those of person and robot, with their labels; pixels.
const ROW: u32 = 150;
/// Height of caption and legend, pixels.
const HEAD: u32 = 96;
/// How long a row is, ms: on more, short movements could not be told apart. Chosen by hand.
const ROW_MS: u64 = 20_000;
/// Later times are left out of the picture: nobody reads a longer one. Chosen by hand.
const MOST_ROWS: u64 = 12;
/// Spans shorter than this are drawn without a label, ms: it would not fit.
const LABELLED_MS: u64 = 900;
/// How much of a label fits into a millisecond, characters.
const CHARACTERS: f64 = 0.0105;

/// What is drawn alike, its name in the legend, and its colour: work in blue and green, waiting in red, standing in grey and yellow.
const LEGEND: [(&str, &[Occupation], RGBColor); 10] = [
    ("reaches", &[Occupation::Reaches], RGBColor(0x9e, 0xc5, 0xe8)),
    ("carries", &[Occupation::Carries], RGBColor(0x3f, 0x83, 0xc4)),
    ("approaches", &[Occupation::Approaches], RGBColor(0x1b, 0x4f, 0x8a)),
    ("handles", &[Occupation::Handles], RGBColor(0x5a, 0xa8, 0x6c)),
    ("steadies", &[Occupation::Steadies], RGBColor(0x2a, 0x75, 0x40)),
    ("prepares", &[Occupation::Prepares], RGBColor(0xb9, 0xa6, 0xd9)),
    ("withdraws", &[Occupation::Withdraws], RGBColor(0xd3, 0xd8, 0xde)),
    ("held back", &[Occupation::HeldBack], RGBColor(0xe3, 0x9b, 0x2d)),
    ("plans", &[Occupation::Plans], RGBColor(0xf1, 0xd9, 0x6b)),
    (
        "waits",
        &[
            Occupation::Waits,
            Occupation::WaitsForSteadying,
            Occupation::WaitsForReceiving,
            Occupation::WaitsForPart,
            Occupation::WaitsForRelease,
            Occupation::WaitsForSubgoal,
        ],
        RGBColor(0xd9, 0x5f, 0x5f),
    ),
];

/// Draws who did what, and who waited for whom: a lane for the person above one for the robot, 20 s in each row.
///
/// # Errors
/// The file cannot be written.
pub fn gantt(spans: &[TimelineSpan], caption: &str, path: &Path) -> Result<(), PlotError> {
    draw(spans, caption, path).map_err(|cause| PlotError::new(path, cause))
}

fn draw(spans: &[TimelineSpan], caption: &str, path: &Path) -> Result<(), Box<dyn Error>> {
    let end = spans.iter().map(|span| span.until_ms).max().unwrap_or(0);
    let rows = end.div_ceil(ROW_MS).clamp(1, MOST_ROWS);
    let area = SVGBackend::new(path, (WIDTH, HEAD + ROW * rows as u32)).into_drawing_area();
    area.fill(&WHITE)?;
    let (head, body) = area.split_vertically(HEAD);
    head.draw_text(caption, &("sans-serif", 20).into_font().color(&BLACK), (20, 12))?;
    for (index, (name, _, colour)) in LEGEND.iter().enumerate() {
        let x = 20 + 132 * index as i32;
        head.draw(&Rectangle::new([(x, 54), (x + 18, 68)], colour.filled()))?;
        head.draw_text(name, &("sans-serif", 15).into_font().color(&BLACK), (x + 25, 54))?;
    }
    for (row, area) in body.split_evenly((rows as usize, 1)).iter().enumerate() {
        let from = row as u64 * ROW_MS;
        draw_row(spans, from..from + ROW_MS, area)?;
    }
    area.present()?;
    Ok(())
}

fn draw_row(
    spans: &[TimelineSpan],
    shown: std::ops::Range<u64>,
    area: &DrawingArea<SVGBackend, plotters::coord::Shift>,
) -> Result<(), Box<dyn Error>> {
    let seconds = |ms: u64| ms as f64 / 1e3;
    let mut chart = ChartBuilder::on(area)
        .margin_left(12)
        .margin_right(24)
        .x_label_area_size(34)
        .y_label_area_size(70)
        .build_cartesian_2d(seconds(shown.start)..seconds(shown.end), 2.0..0.0)?;
    chart
        .configure_mesh()
        .disable_y_mesh()
        .y_labels(0)
        .x_labels(20)
        .x_label_formatter(&|s| format!("{s:.0} s"))
        .light_line_style(WHITE)
        .label_style(("sans-serif", 13))
        .draw()?;
    for (name, lane) in [("person", 0.5), ("robot", 1.5)] {
        let (x, y) = chart.backend_coord(&(seconds(shown.start), lane));
        area.draw_text(name, &("sans-serif", 15).into_font().color(&BLACK), in_area(area, (x - 62, y - 8)))?;
    }
    for span in spans.iter().filter(|span| span.until_ms > shown.start && span.from_ms < shown.end) {
        let Some((_, _, colour)) = LEGEND.iter().find(|(_, alike, _)| alike.contains(&span.occupation))
        else {
            continue;
        };
        let lane = if span.who == Waiting::Person { 0.0 } else { 1.0 };
        let (from, until) = (span.from_ms.max(shown.start), span.until_ms.min(shown.end));
        let corners = [(seconds(from), lane + 0.12), (seconds(until), lane + 0.88)];
        chart.draw_series([Rectangle::new(corners, colour.filled())])?;
        if until - from >= LABELLED_MS {
            let (x, y) = chart.backend_coord(&(seconds(from), lane + 0.5));
            draw_label(area, span, until - from, in_area(area, (x + 3, y)))?;
        }
    }
    Ok(())
}

/// What is done, and what it is about, in two lines, as far as they fit.
fn draw_label(
    area: &DrawingArea<SVGBackend, plotters::coord::Shift>,
    span: &TimelineSpan,
    ms: u64,
    (x, y): (i32, i32),
) -> Result<(), Box<dyn Error>> {
    let fits = |text: &str| text.chars().take((ms as f64 * CHARACTERS) as usize).collect::<String>();
    let style = ("sans-serif", 11).into_font().color(&BLACK);
    area.draw_text(&fits(span.occupation.name()), &style, (x, y - 13))?;
    area.draw_text(&fits(&span.what), &style, (x, y + 2))?;
    Ok(())
}

/// A pixel of the picture as one of the area.
fn in_area(area: &DrawingArea<SVGBackend, plotters::coord::Shift>, (x, y): (i32, i32)) -> (i32, i32) {
    let (left, top) = area.get_base_pixel();
    (x - left, y - top)
}
