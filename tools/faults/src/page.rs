use crate::{MatrixReport, Moment, Outcome};
use std::fmt::Write;

const HEAD: &str =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>coact faults</title>\n<style>
body { font: 15px/1.5 sans-serif; margin: 2em; color: #222 }
table { border-collapse: collapse }
th, td { padding: .2em .7em; border: 1px solid #ddd; text-align: left }
td.green { background: #cfe8cf } td.late { background: #f5e3b3 } td.red { background: #f2c4c0 } td.unknown { background: #ddd }
</style></head><body>\n";

/// The matrix as a page of HTML.
pub fn page(report: &MatrixReport) -> String {
    let [green, late, red, unknown] = report.counts();
    let mut page = format!("{HEAD}<h1>Fault matrix</h1>\n");
    // Writing into a string cannot fail.
    _ = writeln!(
        page,
        "<p>{green} cells green, {late} late, {red} red, {unknown} unknown, in {:.0} s.</p>\n<table><tr><th>fault</th><th>target</th>{}</tr>",
        report.duration_s,
        Moment::ALL.map(|moment| format!("<th>{moment}</th>")).concat()
    );
    for row in report.rows() {
        let cells = row.outcomes.map(|outcome| outcome.map_or("<td></td>".to_owned(), cell)).concat();
        _ = writeln!(page, "<tr><td>{}</td><td>{}</td>{cells}</tr>", row.fault, row.target);
    }
    page.push_str("</table>\n<h2>Why</h2>\n<ul>\n");
    for judged in &report.cells {
        let reasons = match &judged.outcome {
            Outcome::Green => continue,
            Outcome::Red(reasons) | Outcome::Late(reasons) => reasons.join("; "),
            Outcome::Unknown(reason) => format!("unknown: {reason}"),
        };
        _ = writeln!(page, "<li><b>{}</b> {}</li>", judged.cell, escaped(&reasons));
    }
    page.push_str("</ul>\n<h2>Not covered yet</h2>\n<ul>\n");
    for (fault, why) in &report.not_covered {
        _ = writeln!(page, "<li>{fault}: {why}</li>");
    }
    page.push_str("</ul>\n</body></html>\n");
    page
}

fn cell(outcome: &Outcome) -> String {
    let class = match outcome {
        Outcome::Green => "green",
        Outcome::Late(_) => "late",
        Outcome::Red(_) => "red",
        Outcome::Unknown(_) => "unknown",
    };
    format!("<td class=\"{class}\">{class}</td>")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
