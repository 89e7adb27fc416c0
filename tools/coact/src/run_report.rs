//! What is printed after a run: what `summary.json` says, for a person.

use crate::snapshots;
use anyhow::{Context, Result};
use coact_run_records::{
    AnticipationReport, Environment, FaultReport, Judgement, MachineReport, MotionReport, OperatorStopReport,
    OutageReport, SeparationReport, Summary, TaskReport,
};
use owo_colors::{OwoColorize, Stream};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::ExitCode;

/// Prints the summary of a report folder, or with `json` the file itself. Success when the work passes; with `strict`, when
/// the timing does, too.
///
/// # Errors
/// There is no readable `summary.json`.
pub fn show(report: &Path, json: bool, strict: bool) -> Result<ExitCode> {
    let path = report.join(Summary::FILE);
    let text = coact_input_file::read_text_within(&path, coact_input_file::LONGEST_LOG)
        .with_context(|| format!("{}: the run ended before it could be written", path.display()))?;
    let summary = Summary::read(report)?;
    if json {
        println!("{}", text.trim_end());
    } else {
        print!("{}", render(&summary, report));
    }
    let passes = summary.work.passes() && (!strict || summary.timing.passes());
    Ok(if passes { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// A line in red on standard error.
pub fn warn(text: &str) {
    eprintln!("{}", text.if_supports_color(Stream::Stderr, |text| text.red()));
}

fn render(summary: &Summary, report: &Path) -> String {
    let mut lines = vec![String::new()];
    lines.extend(judgement("work", &summary.work));
    // In lockstep no process runs and no clock.
    if !summary.processes.is_empty() {
        lines.extend(judgement("timing", &summary.timing));
        if !summary.timing.passes() {
            lines.push("  what can be improved here: coact check".into());
        }
    }
    lines.push(task(&summary.task));
    let order = summary.task.order.iter().enumerate();
    lines.extend(order.map(|(index, name)| format!("  {:>2}. {name}", index + 1)));
    lines.push(anticipation(&summary.anticipation));
    lines.push(motion(&summary.motion));
    lines.push(separation(&summary.separation));
    if !summary.processes.is_empty() {
        lines.push(latency(summary));
        lines.push(outage(summary));
        lines.extend(summary.environment.machine.as_ref().map(machine));
        lines.push(privileges(&summary.environment));
    }
    lines.extend(summary.refused.iter().map(|(process, reasons)| ignored(process, reasons)));
    lines.extend(summary.operator_stops.iter().map(operator_stop));
    lines.extend(summary.faults.iter().map(fault));
    if summary.blind_s > 0.0 {
        lines.push(format!("monitor       saw nothing for {:.1} s", summary.blind_s));
    }
    lines.push(format!("report        {}", report.display()));
    let recording = report.join("run.mcap");
    if let Ok(file) = recording.metadata() {
        lines.push(format!("recording     {} ({:.0} MB)", recording.display(), file.len() as f64 / 1e6));
    }
    let sheet = snapshots::sheet(report);
    if sheet.is_file() {
        lines.push(format!("snapshots     {}", sheet.display()));
    }
    lines.join("\n") + "\n"
}

/// A verdict, and why it is not "pass".
fn judgement(name: &str, judgement: &Judgement) -> Vec<String> {
    let verdict = match judgement.passes() {
        true => "pass".if_supports_color(Stream::Stdout, |text| text.green()).to_string(),
        false => "fail".if_supports_color(Stream::Stdout, |text| text.red()).to_string(),
    };
    let reasons = judgement.reasons.iter().map(|reason| format!("  - {reason}"));
    std::iter::once(format!("{name:<14}{verdict}")).chain(reasons).collect()
}

fn separation(separation: &SeparationReport) -> String {
    let SeparationReport {
        ticks,
        nearest_m,
        smallest_margin_m,
        robot_closing_ms,
        person_closing_ms,
        contact_ms,
        contact_speed_mps,
        held_back_ms,
        stopped_ms,
    } = separation;
    let Some(nearest) = nearest_m else { return "person        nobody was there".into() };
    format!(
        "person        {:.0} mm away at the least, smallest margin {}; nearer than is kept: robot closing {robot_closing_ms} ms, person \
         {person_closing_ms} ms; contact {contact_ms} ms, at {contact_speed_mps:.2} m/s at most; held back {:.1} % of the time, stopped {:.1} %",
        1e3 * nearest,
        smallest_margin_m.map_or("none".into(), |margin| format!("{:.0} mm", 1e3 * margin)),
        100.0 * *held_back_ms as f64 / (*ticks).max(1) as f64,
        100.0 * *stopped_ms as f64 / (*ticks).max(1) as f64,
    )
}

fn motion(motion: &MotionReport) -> String {
    format!(
        "arm           at most {:.0} % of its joints' speed limits, {:.0} % of their acceleration; moved on old data for {} ms",
        100.0 * motion.speed,
        100.0 * motion.acceleration,
        motion.on_stale_data_ms
    )
}

/// Of the command, and of the process that was missing most.
fn outage(summary: &Summary) -> String {
    let short = |outage: &OutageReport| {
        format!("{} of {} cycles, {} ms at the longest", outage.without_output, outage.due, outage.longest)
    };
    let mut text = format!("outage        command {}", short(&summary.command_outage));
    let worst = summary.processes.iter().max_by_key(|(_, process)| process.outage.without_output);
    if let Some((name, process)) = worst.filter(|(_, process)| process.outage.without_output > 0) {
        text.push_str(&format!("; most of the processes {name}, {}", short(&process.outage)));
    }
    text
}

fn ignored(process: &str, reasons: &BTreeMap<String, u64>) -> String {
    let reasons: Vec<_> = reasons.iter().map(|(reason, count)| format!("{count} {reason}")).collect();
    format!("ignored       by {process}: messages {}", reasons.join(", "))
}

fn task(task: &TaskReport) -> String {
    format!("subgoals      {} of {} achieved, {:.1} s", task.achieved, task.subgoals, task.duration_s)
}

fn anticipation(report: &AnticipationReport) -> String {
    let ms = |lead: Option<i64>| lead.map_or("-".into(), |lead| lead.to_string());
    let lead = &report.lead_ms;
    format!(
        "anticipation  {} actions of the partner, {} decided before the grasp, {} rightly; lead p5 {} p50 {} p95 {} ms",
        report.actions,
        report.decided_before_grasp,
        report.correct,
        ms(lead.p5),
        ms(lead.p50),
        ms(lead.p95)
    )
}

fn latency(summary: &Summary) -> String {
    let times = &summary.end_to_end_ns;
    let named = [("p50", times.p50), ("p99", times.p99), ("p999", times.p999), ("max", times.max)];
    let percentiles = named.map(|(name, ns)| format!("{name} {:.0} µs", ns as f64 / 1e3)).join(", ");
    let processes = summary.processes.values();
    let (missed, skipped, cycles) = processes.fold((0, 0, 0), |(missed, skipped, cycles), process| {
        (missed + process.missed, skipped + process.skipped, cycles + process.cycles)
    });
    format!(
        "end to end    {percentiles}; {missed} of {cycles} cycles missed their deadline, {skipped} were skipped"
    )
}

/// How late the machine was by itself: no process can be more punctual.
fn machine(machine: &MachineReport) -> String {
    let MachineReport { wakeups, late, longest_ns, .. } = machine;
    let longest_ms = *longest_ns as f64 / 1e6;
    format!(
        "machine       late by a period or more at {late} of {wakeups} wake-ups of an idle thread, by {longest_ms:.1} ms \
         at most"
    )
}

/// In red when the metrics were taken without real-time privileges.
fn privileges(environment: &Environment) -> String {
    if environment.memory_locked {
        return "memory        locked".into();
    }
    let text = "memory        not locked: latencies are worse than they could be";
    text.if_supports_color(Stream::Stdout, |text| text.red()).to_string()
}

fn operator_stop(stop: &OperatorStopReport) -> String {
    let resumed = stop.resumed_at_s.zip(stop.resumed_by.as_ref());
    let resumed = resumed.map_or("until the end".into(), |(at_s, by)| format!("until {at_s:.1} s by {by}"));
    format!("stopped       from {:.1} s by {}, {resumed}", stop.at_s, stop.by)
}

fn fault(fault: &FaultReport) -> String {
    let after = |ms: Option<f64>| ms.map_or("never".into(), |ms| format!("after {ms:.1} ms"));
    let machine = match fault.machine_late_ms {
        0.0 => String::new(),
        ms => format!(", the machine was late by {ms:.1} ms meanwhile"),
    };
    format!(
        "fault         {}: {} at {:.1} s, seen {}, recovered {}, others missed {}{machine}",
        fault.process,
        fault.fault,
        fault.at_s,
        after(fault.detected_ms),
        after(fault.recovered_ms),
        fault.survivors_missed
    )
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use coact_run_records::{LeadPercentiles, Percentiles, ProcessReport, ReactionReport, TrackingReport};

    fn process(cycles: u64, missed: u64, skipped: u64) -> ProcessReport {
        let (wakeup_ns, execution_ns) = (Percentiles::default(), Percentiles::default());
        let outage = OutageReport {
            due: 1100,
            without_output: missed + skipped + 90,
            longest: 90,
            longest_from_ms: 7,
        };
        ProcessReport {
            cycles,
            missed,
            skipped,
            longest_miss_run: 1,
            unseen: 0,
            restarts: 0,
            outage,
            wakeup_ns,
            execution_ns,
        }
    }

    fn summary() -> Summary {
        let machine = Some(MachineReport { wakeups: 1000, late: 3, p999_ns: 80_000, longest_ns: 2_345_678 });
        let lead_ms = LeadPercentiles { p5: Some(120), p50: Some(350), p95: None };
        Summary {
            environment: Environment { machine, ..Environment::default() },
            processes: [("fields".into(), process(1000, 2, 4)), ("world".into(), process(1001, 1, 0))].into(),
            hops: Default::default(),
            end_to_end_ns: Percentiles { count: 9, p50: 210_000, p99: 400_400, p999: 512_600, max: 900_000 },
            command_outage: OutageReport { due: 1100, without_output: 95, longest: 91, longest_from_ms: 7 },
            motion: MotionReport { speed: 0.5, acceleration: 0.875, ..MotionReport::default() },
            separation: SeparationReport {
                ticks: 60_000,
                nearest_m: Some(0.0514),
                smallest_margin_m: Some(0.0123),
                person_closing_ms: 12,
                held_back_ms: 6000,
                ..SeparationReport::default()
            },
            blind_s: 1.25,
            tracking_error_rad: TrackingReport::default(),
            movement_reaction_ms: ReactionReport::default(),
            anticipation: AnticipationReport {
                actions: 6,
                decided_before_grasp: 5,
                correct: 4,
                lead_ms,
                events: Vec::new(),
            },
            task: TaskReport {
                subgoals: 9,
                achieved: 2,
                order: vec!["left wheel".into(), "right wheel".into()],
                duration_s: 61.26,
                assemblies: 0,
                decisions: Vec::new(),
                utterances: Vec::new(),
            },
            refused: BTreeMap::new(),
            operator_stops: vec![OperatorStopReport {
                at_s: 4.25,
                by: "user 0 (pid 7)".into(),
                resumed_at_s: Some(6.0),
                resumed_by: Some("user 0 (pid 8)".into()),
            }],
            faults: vec![FaultReport {
                process: "fields".into(),
                fault: "kill".into(),
                at_s: 20.0,
                detected_ms: Some(0.3),
                recovered_ms: Some(21.54),
                survivors_missed: 1,
                survivors_missed_by: Default::default(),
                machine_late_ms: 3.25,
            }],
            work: Judgement::new(vec!["only 2 of 9 subgoals were achieved".into()]),
            timing: Judgement::new(vec!["fields was missing".into()]),
        }
    }

    #[test]
    fn a_person_reads_what_the_summary_says() {
        let text = render(&summary(), Path::new("reports/x"));
        for part in [
            "work          ",
            "only 2 of 9 subgoals were achieved",
            "timing        ",
            "fields was missing\n  what can be improved here: coact check",
            "at most 50 % of its joints' speed limits, 88 % of their acceleration",
            "command 95 of 1100 cycles, 91 ms at the longest; most of the processes fields, 96 of 1100",
            "saw nothing for 1.2 s",
            "2 of 9 achieved, 61.3 s",
            " 2. right wheel",
            "6 actions of the partner, 5 decided before the grasp, 4 rightly; lead p5 120 p50 350 p95 - ms",
            "p50 210 µs, p99 400 µs, p999 513 µs, max 900 µs; 3 of 2001 cycles missed their deadline, 4 were skipped",
            "late by a period or more at 3 of 1000 wake-ups of an idle thread, by 2.3 ms at most",
            "not locked",
            "fields: kill at 20.0 s, seen after 0.3 ms, recovered after 21.5 ms, others missed 1, the machine was late by 3.2 ms meanwhile",
            "stopped       from 4.2 s by user 0 (pid 7), until 6.0 s by user 0 (pid 8)",
            "reports/x",
        ] {
            assert!(text.contains(part), "{part} is not in {text}");
        }
    }

    #[test]
    fn a_run_in_lockstep_shows_no_latencies() {
        let text = render(&Summary { processes: Default::default(), ..summary() }, Path::new("reports/x"));
        assert!(["end to end", "locked", "timing"].iter().all(|part| !text.contains(part)), "{text}");
    }

    #[test]
    fn the_work_decides_and_the_timing_too_where_that_was_asked_for() {
        let folder = tempfile::tempdir().unwrap();
        let judgement = |passes: bool| Judgement::new(if passes { vec![] } else { vec!["why".into()] });
        for (work, timing, strict, code) in [
            (true, true, true, ExitCode::SUCCESS),
            (true, false, false, ExitCode::SUCCESS),
            (true, false, true, ExitCode::FAILURE),
            (false, true, false, ExitCode::FAILURE),
        ] {
            let (work, timing) = (judgement(work), judgement(timing));
            Summary { work, timing, ..summary() }.write(folder.path()).unwrap();
            assert_eq!(show(folder.path(), true, strict).unwrap(), code);
        }
        std::fs::write(folder.path().join(Summary::FILE), "{}").unwrap();
        assert!(show(folder.path(), true, false).is_err());
    }
}
