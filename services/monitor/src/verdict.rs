//! The rules of `verdict.toml`, applied to a summary.

use crate::Rules;
use coact_run_records::{Event, Summary};

/// One sentence for each rule that was broken.
pub(crate) fn reasons(summary: &Summary, events: &[Event], run_s: f64, rules: &Rules) -> Vec<String> {
    let mut reasons = Vec::new();
    task(summary, events, run_s, rules, &mut reasons);
    anticipation(summary, events, rules, &mut reasons);
    deadlines(summary, rules, &mut reasons);
    faults(summary, rules, &mut reasons);
    reasons
}

fn task(summary: &Summary, events: &[Event], run_s: f64, rules: &Rules, reasons: &mut Vec<String>) {
    let task = &summary.task;
    if task.achieved < task.subgoals && run_s >= rules.assembly_within_s {
        let (achieved, all) = (task.achieved, task.subgoals);
        reasons.push(format!("only {achieved} of {all} subgoals were achieved in {run_s:.0} s"));
    }
    for event in events {
        if let Event::Forgotten { at_ms, name } = event {
            let at_s = *at_ms as f64 / 1e3;
            reasons.push(format!("at {at_s:.1} s the fields lost the achieved subgoal \"{name}\""));
        }
    }
}

fn anticipation(summary: &Summary, events: &[Event], rules: &Rules, reasons: &mut Vec<String>) {
    let report = &summary.anticipation;
    if report.actions == 0 {
        return;
    }
    let fraction = |count: usize| count as f64 / report.actions as f64;
    if fraction(report.correct) < rules.anticipated_fraction {
        reasons.push(format!(
            "{} of {} partner actions were anticipated ({:.0} %); at least {:.0} % must be",
            report.correct,
            report.actions,
            100.0 * fraction(report.correct),
            100.0 * rules.anticipated_fraction
        ));
    }
    let wrong = events.iter().filter_map(Event::as_action).filter(|action| action.wrong()).count();
    if fraction(wrong) > rules.wrong_fraction {
        reasons.push(format!(
            "{wrong} of {} partner actions were answered wrongly ({:.0} %); at most {:.0} % may be",
            report.actions,
            100.0 * fraction(wrong),
            100.0 * rules.wrong_fraction
        ));
    }
}

/// A process may be late as often as the machine itself was, and a little more.
fn deadlines(summary: &Summary, rules: &Rules, reasons: &mut Vec<String>) {
    let machine = summary.environment.machine.unwrap_or_default().late;
    for (name, process) in &summary.processes {
        let scheduler = summary.environment.schedulers.get(name);
        let privileged = scheduler.is_some_and(|class| class.starts_with("SCHED_FIFO"));
        let limit = if privileged { rules.missed_fraction } else { rules.missed_fraction_unprivileged };
        let fraction = process.missed.saturating_sub(machine) as f64 / process.cycles.max(1) as f64;
        if fraction > limit {
            reasons.push(format!(
                "{name} missed {} of {} deadlines, the machine itself was late {machine} times; at most {:.2} % may be \
                 missed beyond that",
                process.missed,
                process.cycles,
                100.0 * limit
            ));
        }
    }
}

fn faults(summary: &Summary, rules: &Rules, reasons: &mut Vec<String>) {
    for fault in &summary.faults {
        let what = format!("{} ({}) at {:.1} s", fault.process, fault.fault, fault.at_s);
        match fault.recovered_ms {
            None => reasons.push(format!("{what} was not recovered from")),
            Some(ms) if ms > rules.recovered_within_ms => {
                let limit = rules.recovered_within_ms;
                reasons
                    .push(format!("{what} took {ms:.0} ms to recover from; at most {limit:.0} ms may pass"));
            }
            Some(_) => {}
        }
    }
}
