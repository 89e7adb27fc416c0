//! Draws processes and topics from `coact_messages::topic::ALL`: processes are columns, topics rows.
//!
//! A filled dot writes the topic, an arrow head reads it. The picture has its own background and follows the reader's
//! choice of a light or a dark page.
#![allow(clippy::unwrap_used)]

use coact_messages::TopicEntry;
use coact_messages::topic::{ALL, ANYONE};
use std::fmt::Write;

/// The processes from left to right, and what stands below their names.
const COLUMNS: [(&str, &str); 10] = [
    (ANYONE, "coact say, ..."),
    ("world", "simulation"),
    ("perception", "evidence"),
    ("fields", "the mind"),
    ("control", "the arm"),
    ("voice", "sentences"),
    ("monitor", "the report"),
    ("recorder", "run.mcap"),
    ("console", "the browser"),
    ("supervisor", "restarts"),
];
/// Where each block of rows begins, and its heading.
const BLOCKS: [(usize, &str); 3] = [
    (0, "the chain of one cycle, 1 kHz"),
    (4, "beside the chain"),
    (8, "closed to all but these readers; restarts"),
];

// Sizes in px: chosen so that the text is legible at the width of a page (about 900 px).
const LABELS: usize = 150;
const COLUMN: usize = 104;
const HEAD: usize = 84;
const ROW: usize = 44;
const HEADING: usize = 30;
const FOOT: usize = 42;

/// Light colours first, then those of a dark page.
const STYLE: &str = "
  .page { fill: #ffffff; stroke: #d0d7de }
  .box { fill: #f6f8fa; stroke: #8c959f }
  .life { stroke: #d0d7de; stroke-dasharray: 2 4 }
  .rule { stroke: #d8dee4 }
  .lane { stroke-width: 2.2; fill: none }
  text { fill: #1f2328; font-family: -apple-system, 'Segoe UI', 'DejaVu Sans', Helvetica, Arial, sans-serif }
  .process { font-size: 14px; font-weight: 600; text-anchor: middle }
  .does { font-size: 11px; fill: #59636e; text-anchor: middle }
  .topic { font-size: 13px; font-weight: 600 }
  .message { font-size: 11px; fill: #59636e }
  .heading { font-size: 11px; fill: #59636e; letter-spacing: 0.04em }
  .c0 { stroke: #0969da; fill: #0969da } .c1 { stroke: #1a7f37; fill: #1a7f37 }
  .c2 { stroke: #8250df; fill: #8250df } .c3 { stroke: #bc4c00; fill: #bc4c00 }
  .c4 { stroke: #57606a; fill: #57606a } .c5 { stroke: #bf3989; fill: #bf3989 }
  @media (prefers-color-scheme: dark) {
    .page { fill: #0d1117; stroke: #30363d }
    .box { fill: #161b22; stroke: #6e7681 }
    .life { stroke: #30363d }
    .rule { stroke: #21262d }
    text { fill: #e6edf3 }
    .does, .message, .heading { fill: #9198a1 }
    .c0 { stroke: #4493f8; fill: #4493f8 } .c1 { stroke: #3fb950; fill: #3fb950 }
    .c2 { stroke: #ab7df8; fill: #ab7df8 } .c3 { stroke: #f0883e; fill: #f0883e }
    .c4 { stroke: #9198a1; fill: #9198a1 } .c5 { stroke: #db61a2; fill: #db61a2 }
  }
";

/// The whole picture as SVG.
pub fn drawing() -> String {
    let (width, height) = (LABELS + COLUMNS.len() * COLUMN + 8, row(ALL.len() - 1) + FOOT + ROW / 2);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         role=\"img\" aria-label=\"Processes and topics: who writes and who reads what\">\n<style>{STYLE}</style>\n\
         <rect class=\"page\" x=\"0.5\" y=\"0.5\" width=\"{}\" height=\"{}\" rx=\"8\"/>\n",
        width - 1,
        height - 1
    );
    for (column, (name, does)) in COLUMNS.iter().enumerate() {
        draw_process(&mut svg, x(column), name, does, height);
    }
    for (first, heading) in BLOCKS {
        let y = row(first) - ROW / 2 - 8;
        line(&mut svg, "rule", [12, y - 14], [width - 12, y - 14]);
        text(&mut svg, "heading", 16, y + 3, heading);
    }
    for (index, entry) in ALL.iter().enumerate() {
        draw_topic(&mut svg, row(index), entry);
    }
    draw_legend(&mut svg, height - 18);
    svg.push_str("</svg>\n");
    svg
}

fn draw_process(svg: &mut String, x: usize, name: &str, does: &str, height: usize) {
    line(svg, "life", [x, HEAD - 14], [x, height - FOOT]);
    let (left, width) = (x - COLUMN / 2 + 5, COLUMN - 10);
    let corners = if name == ANYONE { 21 } else { 6 };
    put(
        svg,
        format_args!(
            "<rect class=\"box\" x=\"{left}\" y=\"26\" width=\"{width}\" height=\"44\" rx=\"{corners}\"/>"
        ),
    );
    text(svg, "process", x, 45, name);
    text(svg, "does", x, 61, does);
}

/// The row of a topic: its name, a line over all who take part, a dot at writers, an arrow head at readers.
fn draw_topic(svg: &mut String, y: usize, entry: &TopicEntry) {
    text(svg, "topic", 16, y - 1, entry.name.trim_start_matches("coact/"));
    text(svg, "message", 16, y + 13, entry.message);
    let colour = format!("c{}", colour_of(entry));
    let places = |names: &[&str]| names.iter().map(|name| x(column(name))).collect::<Vec<_>>();
    let (writers, readers) = (places(entry.writers), places(entry.readers));
    let all = || writers.iter().chain(&readers).copied();
    let (first, last) = (all().min().unwrap(), all().max().unwrap());
    line(svg, &format!("lane {colour}"), [first, y], [last, y]);
    for &at in readers.iter().filter(|at| !writers.contains(at)) {
        // It points away from the nearest writer.
        let from = *writers.iter().min_by_key(|writer| writer.abs_diff(at)).unwrap();
        let (tip, back) = if from < at { (at + 2, at - 11) } else { (at - 2, at + 11) };
        let (over, under) = (y - 6, y + 6);
        put(
            svg,
            format_args!("<path class=\"{colour}\" d=\"M{tip} {y} L{back} {over} L{back} {under} Z\"/>"),
        );
    }
    for &at in &writers {
        put(svg, format_args!("<circle class=\"{colour}\" cx=\"{at}\" cy=\"{y}\" r=\"6\"/>"));
        if readers.contains(&at) {
            put(
                svg,
                format_args!(
                    "<circle class=\"lane {colour}\" style=\"fill: none\" cx=\"{at}\" cy=\"{y}\" r=\"10\"/>"
                ),
            );
        }
    }
}

fn draw_legend(svg: &mut String, y: usize) {
    put(svg, format_args!("<circle class=\"c4\" cx=\"22\" cy=\"{}\" r=\"5\"/>", y - 4));
    text(svg, "message", 34, y, "writes");
    let (over, middle, under) = (y - 10, y - 4, y + 2);
    put(svg, format_args!("<path class=\"c4\" d=\"M97 {middle} L84 {over} L84 {under} Z\"/>"));
    text(svg, "message", 104, y, "reads");
    put(svg, format_args!("<circle class=\"c4\" cx=\"160\" cy=\"{middle}\" r=\"4\"/>"));
    put(
        svg,
        format_args!("<circle class=\"lane c4\" style=\"fill: none\" cx=\"160\" cy=\"{middle}\" r=\"8\"/>"),
    );
    text(svg, "message", 175, y, "reads its own newest message");
    text(
        svg,
        "message",
        392,
        y,
        "anyone else may read the open topics; each stage has a pulse and a resume topic of its own",
    );
}

/// The chain has a colour for each topic; what is beside it has one by its first writer.
fn colour_of(entry: &TopicEntry) -> usize {
    match entry.writers[0] {
        ANYONE => 5,
        _ if entry.writers.len() > 1 => 4,
        "world" => 0,
        "perception" => 1,
        "fields" => 2,
        "control" => 3,
        "supervisor" => 4,
        _ => 5,
    }
}

fn column(process: &str) -> usize {
    let found = COLUMNS.iter().position(|(name, _)| *name == process);
    found.unwrap_or_else(|| panic!("{process} has no column in {}; add one to COLUMNS", file!()))
}

fn x(column: usize) -> usize {
    LABELS + column * COLUMN + COLUMN / 2
}

fn row(index: usize) -> usize {
    let headings = BLOCKS.iter().filter(|(first, _)| *first <= index).count();
    HEAD + headings * HEADING + index * ROW + ROW / 2
}

fn line(svg: &mut String, class: &str, [x1, y1]: [usize; 2], [x2, y2]: [usize; 2]) {
    put(svg, format_args!("<line class=\"{class}\" x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\"/>"));
}

fn text(svg: &mut String, class: &str, x: usize, y: usize, text: &str) {
    put(svg, format_args!("<text class=\"{class}\" x=\"{x}\" y=\"{y}\">{text}</text>"));
}

fn put(svg: &mut String, element: std::fmt::Arguments) {
    writeln!(svg, "{element}").unwrap();
}
