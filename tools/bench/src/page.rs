use crate::Measured;
use coact_drawing::{Anchor, BLACK, DISTINCT, DrawingError, FAINT, Sheet};
use hdrhistogram::Histogram;
use std::fmt::Write;

/// Width of the picture, and of its margins, pixels.
const WIDTH: i32 = 900;
const LEFT: i32 = 70;
const TOP: i32 = 20;
/// Height of the curves.
const HEIGHT: i32 = 380;
/// Curves from the median to one in a million, in powers of ten of the fraction beyond; durations from 1 µs to 100 ms.
const DECADES: f64 = 6.0;
const LEAST_NS: f64 = 1e3;
const DURATIONS: f64 = 5.0;
/// What is drawn beside the hops of the report: the whole way, and the raw hop.
const DRAWN: [&str; 2] = ["end-to-end", "hop.raw"];

const HEAD: &str = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>coact bench latency</title>\n<style>
body { font: 15px/1.5 sans-serif; margin: 2em; color: #222 }
table { border-collapse: collapse }
th, td { padding: .2em .7em; border: 1px solid #ddd; text-align: right }
</style></head><body>\n";

/// The report as a page of HTML: percentile curves, kills and the slowest cycles.
///
/// # Errors
/// The drawing library's.
pub fn page(measured: &Measured) -> Result<String, DrawingError> {
    let report = &measured.report;
    let mut page =
        format!("{HEAD}<h1>Latency, load {}</h1>\n{}\n<h2>Kills</h2>\n", report.load, curves(measured)?);
    page.push_str("<table><tr><th>process</th><th>at</th><th>seen after</th><th>recovered after</th><th>others missed</th></tr>\n");
    // Writing into a string cannot fail.
    for kill in &report.kills {
        let ms = |value: Option<f64>| value.map_or("never".into(), |ms| format!("{ms:.1} ms"));
        let (seen, recovered) = (ms(kill.detected_ms), ms(kill.recovered_ms));
        _ = writeln!(
            page,
            "<tr><td>{}</td><td>{:.1} s</td><td>{seen}</td><td>{recovered}</td><td>{}</td></tr>",
            kill.process, kill.at_s, kill.survivors_missed
        );
    }
    page.push_str(
        "</table>\n<h2>Slowest cycles</h2>\n<p>µs after the release: due, started, published</p>\n<table>\n",
    );
    for cycle in &report.slowest {
        let us = |ns: u64| ns / 1000;
        _ = write!(page, "<tr><td>{}</td><td>{} µs</td>", cycle.cycle, us(cycle.end_to_end_ns));
        for stage in &cycle.stages {
            let (due, started, published) = (us(stage.due_ns), us(stage.started_ns), us(stage.published_ns));
            _ = write!(page, "<td>{}: {due}, {started}, {published}</td>", stage.process);
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</table>\n</body></html>\n");
    Ok(page)
}

/// Percentile curves, both axes logarithmic.
fn curves(measured: &Measured) -> Result<String, DrawingError> {
    let mut sheet = Sheet::new(WIDTH as u32);
    sheet.height = (TOP + HEIGHT + 50) as u32;
    sheet.block([0, 0], [WIDTH, TOP + HEIGHT + 50], coact_drawing::RGBColor(255, 255, 255));
    for decade in 0..=DURATIONS as i32 {
        let at = y(LEAST_NS * 10f64.powi(decade));
        sheet.path([[LEFT, at], [WIDTH - 20, at]], FAINT, 1);
        sheet.text(
            ["1 µs", "10 µs", "100 µs", "1 ms", "10 ms", "100 ms"][decade as usize],
            [LEFT - 8, at],
            12,
            Anchor::End,
        );
    }
    for decade in 0..=DECADES as i32 {
        let beyond = 10f64.powi(decade);
        sheet.path([[x(beyond), TOP], [x(beyond), TOP + HEIGHT]], FAINT, 1);
        let name = ["0 %", "90 %", "99 %", "99.9 %", "99.99 %", "99.999 %", "99.9999 %"][decade as usize];
        sheet.text(name, [x(beyond), TOP + HEIGHT + 14], 12, Anchor::Middle);
    }
    sheet.frame([LEFT, TOP], [WIDTH - 20, TOP + HEIGHT], BLACK);
    let is_drawn = |name: &str| DRAWN.contains(&name) || measured.report.hops.contains_key(name);
    let drawn = measured.histograms.iter().filter(|(name, _)| is_drawn(name));
    for (index, (name, histogram)) in drawn.enumerate() {
        let colour = DISTINCT[index % DISTINCT.len()];
        sheet.path(curve(histogram), colour, 2);
        let at = TOP + 16 + 18 * index as i32;
        sheet.path([[LEFT + 12, at], [LEFT + 36, at]], colour, 3);
        sheet.text(name.as_str(), [LEFT + 44, at], 13, Anchor::Start);
    }
    sheet.svg()
}

fn curve(histogram: &Histogram<u64>) -> Vec<[i32; 2]> {
    let beyond_one = (histogram.len() as f64).clamp(1.0, 10f64.powf(DECADES));
    let place = |quantile: f64, value: u64| [x((1.0 / (1.0 - quantile)).min(beyond_one)), y(value as f64)];
    histogram.iter_quantiles(16).map(|at| place(at.quantile(), at.value_iterated_to())).collect()
}

fn x(beyond: f64) -> i32 {
    LEFT + (f64::from(WIDTH - 20 - LEFT) * beyond.log10() / DECADES) as i32
}

fn y(ns: f64) -> i32 {
    TOP + HEIGHT - (f64::from(HEIGHT) * (ns.max(LEAST_NS) / LEAST_NS).log10() / DURATIONS) as i32
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::{LatencyReport, SlowCycle, StageTimes};
    use coact_monitor::histogram;
    use std::collections::BTreeMap;

    #[test]
    fn a_page_has_a_curve_for_the_whole_way_and_a_row_for_each_slow_cycle() {
        let mut took = histogram();
        (1..=1000).for_each(|us| took.record(us * 1000).unwrap());
        let stage = StageTimes {
            process: "control".into(),
            generation: 0,
            due_ns: 1000,
            started_ns: 2000,
            published_ns: 3000,
        };
        let report = LatencyReport {
            load: "none",
            slowest: vec![SlowCycle { cycle: 4711, end_to_end_ns: 900_000, stages: vec![stage] }],
            ..LatencyReport::default()
        };
        let histograms =
            BTreeMap::from(["end-to-end", "wakeup.world"].map(|name| (name.to_owned(), took.clone())));
        let page = page(&Measured { report, histograms }).unwrap();
        assert!(page.contains("end-to-end") && !page.contains("wakeup.world"), "{page}");
        assert!(page.contains("<td>4711</td><td>900 µs</td><td>control: 1, 2, 3</td>"), "{page}");
        assert_eq!((y(1e3), y(1e8)), (TOP + HEIGHT, TOP));
    }
}
