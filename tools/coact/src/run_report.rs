//! What is printed after a run: what `summary.json` says, for a person.

use crate::snapshots;
use anyhow::{Context, Result};
use owo_colors::{OwoColorize, Stream};
use serde_json::Value;
use std::path::Path;
use std::process::ExitCode;

/// Prints the summary of a report folder, or with `json` the file itself; success when the verdict is "pass".
///
/// # Errors
/// There is no readable `summary.json`.
pub fn show(report: &Path, json: bool) -> Result<ExitCode> {
    let path = report.join("summary.json");
    let text = std::fs::read_to_string(&path)
        .with_context(|| format!("{}: the run ended before it could be written", path.display()))?;
    let summary: Value = serde_json::from_str(&text).with_context(|| path.display().to_string())?;
    if json {
        println!("{}", text.trim_end());
    } else {
        print!("{}", render(&summary, report));
    }
    Ok(if passed(&summary) { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// A line in red on standard error.
pub fn warn(text: &str) {
    eprintln!("{}", text.if_supports_color(Stream::Stderr, |text| text.red()));
}

fn passed(summary: &Value) -> bool {
    summary["verdict"] == "pass"
}

fn render(summary: &Value, report: &Path) -> String {
    let mut lines = vec![String::new(), verdict(summary)];
    lines.extend(list(&summary["reasons"]).map(|reason| format!("  - {}", words(reason))));
    lines.push(task(&summary["task"]));
    let order = list(&summary["task"]["order"]).enumerate();
    lines.extend(order.map(|(index, name)| format!("  {:>2}. {}", index + 1, words(name))));
    lines.push(anticipation(&summary["anticipation"]));
    // In lockstep no process runs and no clock.
    if values(&summary["processes"]).next().is_some() {
        lines.push(latency(summary));
        lines.extend(machine(&summary["environment"]["machine"]));
        lines.push(privileges(&summary["environment"]));
    }
    lines.extend(list(&summary["faults"]).map(fault));
    lines.push(format!("report        {}", report.display()));
    let sheet = snapshots::sheet(report);
    if sheet.is_file() {
        lines.push(format!("snapshots     {}", sheet.display()));
    }
    lines.join("\n") + "\n"
}

fn verdict(summary: &Value) -> String {
    let word = words(&summary["verdict"]);
    match passed(summary) {
        true => format!("verdict       {}", word.if_supports_color(Stream::Stdout, |text| text.green())),
        false => format!("verdict       {}", word.if_supports_color(Stream::Stdout, |text| text.red())),
    }
}

fn task(task: &Value) -> String {
    let (achieved, subgoals) = (words(&task["achieved"]), words(&task["subgoals"]));
    format!("subgoals      {achieved} of {subgoals} achieved, {:.1} s", number(&task["duration_s"]))
}

fn anticipation(anticipation: &Value) -> String {
    let count = |key: &str| words(&anticipation[key]);
    let lead = match &anticipation["lead_ms"] {
        Value::Null => String::new(),
        lead => format!(
            "; lead p5 {} p50 {} p95 {} ms",
            words(&lead["p5"]),
            words(&lead["p50"]),
            words(&lead["p95"])
        ),
    };
    let (actions, decided, correct) = (count("actions"), count("decided_before_grasp"), count("correct"));
    format!(
        "anticipation  {actions} actions of the partner, {decided} decided before the grasp, {correct} rightly{lead}"
    )
}

fn latency(summary: &Value) -> String {
    let times = &summary["end_to_end_ns"];
    let micros = |key: &str| format!("{key} {:.0} µs", number(&times[key]) / 1e3);
    let total = |key: &str| -> u64 {
        values(&summary["processes"]).filter_map(|process| process[key].as_u64()).sum()
    };
    let (missed, skipped, cycles) = (total("missed"), total("skipped"), total("cycles"));
    let percentiles = ["p50", "p99", "p999", "max"].map(micros).join(", ");
    format!(
        "end to end    {percentiles}; {missed} of {cycles} cycles missed their deadline, {skipped} were skipped"
    )
}

/// How late the machine was by itself: no chain can be more punctual.
fn machine(machine: &Value) -> Option<String> {
    let late = machine["late"].as_u64()?;
    let longest = number(&machine["longest_ns"]) / 1e6;
    let wakeups = words(&machine["wakeups"]);
    Some(format!(
        "machine       late by a period or more at {late} of {wakeups} wake-ups of an idle thread, by {longest:.1} ms at most"
    ))
}

/// In red when the metrics were taken without real-time privileges.
fn privileges(environment: &Value) -> String {
    match environment["memory_locked"].as_bool() {
        Some(false) => {
            let text = "memory        not locked: latencies are worse than they could be";
            text.if_supports_color(Stream::Stdout, |text| text.red()).to_string()
        }
        _ => "memory        locked".into(),
    }
}

fn fault(fault: &Value) -> String {
    let milliseconds =
        |key: &str| fault[key].as_f64().map_or("never".into(), |ms| format!("after {ms:.1} ms"));
    let (name, process) = (words(&fault["fault"]), words(&fault["process"]));
    format!(
        "fault         {process}: {name} at {:.1} s, seen {}, recovered {}, others missed {}",
        number(&fault["at_s"]),
        milliseconds("detected_ms"),
        milliseconds("recovered_ms"),
        words(&fault["survivors_missed"])
    )
}

fn list(value: &Value) -> impl Iterator<Item = &Value> {
    value.as_array().into_iter().flatten()
}

fn values(value: &Value) -> impl Iterator<Item = &Value> {
    value.as_object().into_iter().flat_map(|object| object.values())
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(0.0)
}

/// Text without its quotation marks, anything else as it is.
fn words(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn summary(verdict: &str) -> Value {
        json!({
            "environment": { "memory_locked": false,
                "machine": { "wakeups": 1000, "late": 3, "longest_ns": 2_345_678 } },
            "processes": { "fields": { "cycles": 1000, "missed": 2, "skipped": 4 }, "world": { "cycles": 1001, "missed": 1 } },
            "end_to_end_ns": { "count": 9, "p50": 210_000, "p99": 400_400, "p999": 512_600, "max": 900_000 },
            "anticipation": { "actions": 6, "decided_before_grasp": 5, "correct": 4,
                "lead_ms": { "p5": 120, "p50": 350, "p95": 600 } },
            "task": { "subgoals": 9, "achieved": 2, "order": ["left wheel", "right wheel"], "duration_s": 61.26 },
            "faults": [{ "process": "fields", "fault": "kill", "at_s": 20.0, "detected_ms": 0.3,
                "recovered_ms": 21.54, "survivors_missed": 1 }],
            "verdict": verdict,
            "reasons": ["only 2 of 9 subgoals were achieved"]
        })
    }

    #[test]
    fn a_person_reads_what_the_summary_says() {
        let text = render(&summary("fail"), Path::new("reports/x"));
        for part in [
            "fail",
            "only 2 of 9 subgoals were achieved",
            "2 of 9 achieved, 61.3 s",
            " 2. right wheel",
            "6 actions of the partner, 5 decided before the grasp, 4 rightly; lead p5 120 p50 350 p95 600 ms",
            "p50 210 µs, p99 400 µs, p999 513 µs, max 900 µs; 3 of 2001 cycles missed their deadline, 4 were skipped",
            "late by a period or more at 3 of 1000 wake-ups of an idle thread, by 2.3 ms at most",
            "not locked",
            "fields: kill at 20.0 s, seen after 0.3 ms, recovered after 21.5 ms, others missed 1",
            "reports/x",
        ] {
            assert!(text.contains(part), "{part} is not in {text}");
        }
    }

    #[test]
    fn a_run_in_lockstep_shows_no_latencies() {
        let mut summary = summary("pass");
        summary["processes"] = json!({});
        let text = render(&summary, Path::new("reports/x"));
        assert!(!text.contains("end to end") && !text.contains("locked"), "{text}");
    }

    #[test]
    fn only_the_verdict_decides() {
        assert!(passed(&summary("pass")));
        assert!(!passed(&summary("fail")));
        assert!(!passed(&json!({})));
    }
}
