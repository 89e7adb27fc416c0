//! The rules of `verdict.toml`, applied to a summary.

use crate::Rules;
use coact_run_records::{Event, JointMoment, MotionReport, OutageReport, SeparationReport, Summary};

/// What was done, one sentence for each rule that was broken: task, anticipation, safety, nothing lost.
pub(crate) fn work(summary: &Summary, events: &[Event], run_s: f64, rules: &Rules) -> Vec<String> {
    let mut reasons = Vec::new();
    task(summary, events, run_s, rules, &mut reasons);
    anticipation(summary, events, rules, &mut reasons);
    faults(summary, rules, &mut reasons);
    motion(&summary.motion, rules, &mut reasons);
    separation(&summary.separation, rules, &mut reasons);
    if summary.blind_s > rules.blind_s {
        reasons.push(format!(
            "the monitor saw nothing for {:.1} s, so that this report says nothing about them; at most {:.1} s may be unseen",
            summary.blind_s, rules.blind_s
        ));
    }
    reasons
}

/// How punctual it was, likewise: outage and end to end. Of a run in lockstep nothing, for no clock runs in it.
pub(crate) fn timing(summary: &Summary, rules: &Rules) -> Vec<String> {
    let mut reasons = Vec::new();
    for (name, process) in &summary.processes {
        let scheduler = summary.environment.schedulers.get(name);
        let privileged = scheduler.is_some_and(|class| class.starts_with("SCHED_FIFO"));
        outage(name, &process.outage, privileged, summary, rules, &mut reasons);
    }
    let privileged = summary.environment.schedulers.values().any(|class| class.starts_with("SCHED_FIFO"));
    outage("the command to the arm", &summary.command_outage, privileged, summary, rules, &mut reasons);
    end_to_end(summary, rules, &mut reasons);
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

/// What happened at the joints, whoever commanded it.
fn motion(motion: &MotionReport, rules: &Rules, reasons: &mut Vec<String>) {
    let mut fraction = |what: &str, found: f64, at: JointMoment, limit: f64| {
        if found > limit {
            reasons.push(format!(
                "the {what} of joint {} was {found:.2} times its limit at {:.1} s; at most {limit:.2} times is allowed",
                at.joint, at.s
            ));
        }
    };
    fraction("speed", motion.speed, motion.speed_at, rules.joint_speed_fraction);
    fraction("acceleration", motion.acceleration, motion.acceleration_at, rules.joint_acceleration_fraction);
    if motion.beyond_position_rad > rules.joint_beyond_rad {
        reasons
            .push(format!("a joint was {:.4} rad beyond its limit of position", motion.beyond_position_rad));
    }
    if motion.on_stale_data_ms > rules.moved_on_stale_data_ms {
        reasons.push(format!(
            "the arm still moved {} ms after its newest data had become too old; within {} ms it must stand",
            motion.on_stale_data_ms, rules.moved_on_stale_data_ms
        ));
    }
}

/// What came too near the person by the robot's own motion.
fn separation(separation: &SeparationReport, rules: &Rules, reasons: &mut Vec<String>) {
    if separation.robot_closing_ms > rules.robot_closing_ms {
        reasons.push(format!(
            "the robot came nearer to the person by its own motion for {} ms while it was nearer than the protective \
             separation ({:.0} mm at the least); at most {} ms are allowed",
            separation.robot_closing_ms,
            1e3 * separation.nearest_m.unwrap_or_default(),
            rules.robot_closing_ms
        ));
    }
    if separation.contact_speed_mps > rules.contact_speed_mps {
        reasons.push(format!(
            "the robot touched the person, outside a handover, at {:.2} m/s; at most {:.2} m/s are allowed",
            separation.contact_speed_mps, rules.contact_speed_mps
        ));
    }
}

/// Outputs may be missing as often as the machine itself was late, and a little more often; never for long at a time.
fn outage(
    name: &str,
    outage: &OutageReport,
    privileged: bool,
    summary: &Summary,
    rules: &Rules,
    reasons: &mut Vec<String>,
) {
    let machine = summary.environment.machine.unwrap_or_default().late;
    let limit = if privileged { rules.outage_fraction } else { rules.outage_fraction_unprivileged };
    let fraction = outage.without_output.saturating_sub(machine) as f64 / outage.due.max(1) as f64;
    if fraction > limit || outage.longest > rules.longest_outage_ms {
        reasons.push(format!(
            "{name} was missing or late in {} of {} cycles, for {} ms from {:.1} s on at the longest; the machine itself was \
             late {machine} times, and at most {:.2} % beyond that, and {} ms at a time, may be missing",
            outage.without_output,
            outage.due,
            outage.longest,
            outage.longest_from_ms as f64 / 1e3,
            100.0 * limit,
            rules.longest_outage_ms
        ));
    }
}

fn end_to_end(summary: &Summary, rules: &Rules, reasons: &mut Vec<String>) {
    let ms = |ns: u64| ns as f64 / 1e6;
    let machine = ms(summary.environment.machine.unwrap_or_default().p999_ns);
    let beyond = rules.end_to_end_p999_times_machine * machine + rules.end_to_end_p999_beyond_machine_ms;
    let (found, limit) = (ms(summary.end_to_end_ns.p999), rules.end_to_end_p999_ms.max(beyond));
    if found > limit {
        reasons.push(format!(
            "one command in 1000 came {found:.2} ms after its sensor sample, or later; at most {limit:.2} ms may pass \
             (an idle thread of this machine was late by {machine:.2} ms as often)"
        ));
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
