//! The metrics of an evaluation as a table.

use super::Evaluation;
use coact_evaluation::{
    ChangesOfMind, Comparison, Estimate, EvaluationReport, Hesitations, KnownPeople, Proportion, Spread,
    TimeReport,
};
use comfy_table::{Table, presets::UTF8_HORIZONTAL_ONLY};

/// Prints all metrics, beside those of the baseline if there is one.
pub(super) fn print(evaluation: &Evaluation) {
    let Evaluation {
        tasks,
        layout,
        movement,
        world,
        planner_delay,
        partner,
        person,
        seed,
        trials,
        assemblies,
        report,
        without,
        baseline,
        comparison,
    } = evaluation;
    let task = match tasks.as_slice() {
        [task] => task.clone(),
        tasks => format!("{} tasks", tasks.len()),
    };
    let many = match assemblies {
        1 => format!("{trials} assemblies"),
        _ => format!("{trials} times {assemblies} assemblies one after another"),
    };
    let lacks = without.unwrap_or_default();
    let (layout, movement, world) = (layout.told(), movement.told(), world.name());
    let delay = planner_delay.as_ref().map_or(String::new(), |delay| format!(", plans held back: {delay}"));
    println!(
        "{task}: {many} with {partner}, people as in {}, in the {world} world{layout}{movement}{delay}, seeds from {seed}; 95 % intervals",
        person.display()
    );
    let mut table = Table::new();
    table.load_style(UTF8_HORIZONTAL_ONLY);
    let one = rows(report);
    match baseline.as_ref().map(rows) {
        None => {
            table.set_header(["metric", "value"]);
            table.add_rows(one.into_iter().map(|(name, value)| [name, value]));
        }
        Some(other) => {
            table.set_header(["metric", &format!("with {lacks}"), "without"]);
            let both = one.into_iter().zip(other);
            table.add_rows(both.map(|((name, value), (_, rival))| [name, value, rival]));
        }
    }
    println!("{table}");
    if let Some(comparison) = comparison {
        compare(comparison, lacks);
    }
}

/// Prints how the robot differs from its baseline, over the assemblies that both completed.
fn compare(comparison: &Comparison, lacks: &str) {
    println!("with against without {lacks}, {} assemblies that both completed:", comparison.pairs);
    for (name, estimate) in [
        ("functional delay, ratio", comparison.functional_delay_ratio),
        ("functional delay, difference", comparison.functional_delay_difference),
        ("functional delay of answers, ratio", comparison.answer_delay_ratio),
        ("waiting of the person, ratio", comparison.waiting_ratio),
        ("task time, ratio", comparison.time_ratio),
    ] {
        println!("  {name:30} {}", interval(estimate, 1.0, 3, ""));
    }
}

/// Name and value of every metric.
fn rows(report: &EvaluationReport) -> Vec<(String, String)> {
    let row = |name: &str, value: String| (name.to_owned(), value);
    let millimetres =
        |length: Option<f64>| length.map_or("-".into(), |length| format!("{:.0}", 1e3 * length));
    let percent = |fraction: Option<Estimate>| interval(fraction, 100.0, 1, " %");
    let mut rows = vec![
        row("completed", proportion(&report.completed)),
        row("deadlocks", proportion(&report.deadlocks)),
        row("task time, s", interval(report.seconds, 1.0, 1, "")),
        row("nearest to the person, mm", millimetres(report.nearest_m)),
        row("  smallest margin, mm", millimetres(report.smallest_margin_m)),
        row("  robot closing beyond the separation, ms", report.robot_closing_ms.to_string()),
        row("  person closing, ms", report.person_closing_ms.to_string()),
        row("  contact, ms", format!("{}, at most {:.2} m/s", report.contact_ms, report.contact_speed_mps)),
        row(
            "arm held back, stopped",
            format!("{:.1} %, {:.1} %", 100.0 * report.held_back, 100.0 * report.stopped),
        ),
        row("setpoints followed within 20 mrad", proportion(&report.tracked)),
        row("  farthest from them, mrad", format!("{:.1}", 1e3 * report.tracking_error_rad)),
        row("goal inferred rightly at grasp", proportion(&report.right)),
        row("  wrongly", proportion(&report.wrong)),
        row("  not", proportion(&report.absent)),
        row("first goal that stood 50 ms was right", proportion(&report.first_right)),
        row("  wrong", proportion(&report.first_wrong)),
        row("  none stood", proportion(&report.first_absent)),
        row("  rightly, of wrong actions", proportion(&report.right_of_errors)),
        row("goal inferred rightly at grasp, hidden hands", proportion(&report.right_of_hidden)),
        row("  wrongly, hidden hands", proportion(&report.wrong_of_hidden)),
        row("  not, hidden hands", proportion(&report.absent_of_hidden)),
        row("  rightly, where one goal is left", proportion(&report.right_of_hidden_one_goal)),
        row("goal inferred rightly at grasp, left hand", proportion(&report.right_of_left)),
        row("  wrongly, left hand", proportion(&report.wrong_of_left)),
        row("answer decided before grasp", proportion(&report.anticipated)),
        row("  before the hand set out: predicted", proportion(&report.predicted)),
        row("lead of the others p5 p50 p95, ms", spread(report.lead_ms)),
        row("  mean", interval(report.mean_lead_ms, 1.0, 0, "")),
    ];
    rows.extend(report.known_people.iter().flat_map(rows_of_known_people));
    for tally in report.first_by_angle.iter().filter(|tally| tally.right.of > 0) {
        let wrong = format!("; wrong {}", tally.wrong.count);
        let name = format!("first goal right, next part {} to {}°", tally.from_deg, tally.below_deg);
        rows.push(row(&name, proportion(&tally.right) + &wrong));
    }
    for tally in &report.errors {
        let late = format!(
            "; answered in {}, noticed late in {}, never in {}",
            tally.answered.count, tally.late.count, tally.missed.count
        );
        rows.push(row(
            &format!("noticed in time and answered: {}", tally.kind.name()),
            proportion(&tally.in_time) + &late,
        ));
    }
    rows.extend([
        row("false alarms per valid action", proportion(&report.false_alarms)),
        row("ticks with two peaks", report.double_peaks.to_string()),
        row("human idle", percent(report.human_idle)),
        row("robot idle", percent(report.robot_idle)),
        row("concurrent activity", percent(report.concurrent)),
        row("functional delay", percent(report.functional_delay)),
        row("functional delay of answers, ms", interval(report.answer_delay_ms, 1.0, 1, "")),
        row("person waits within actions", percent(report.human_waits)),
    ]);
    rows.extend(rows_of_time(&report.time));
    for (changes, to) in
        [(report.changes_of_mind, "mind changed"), (report.changes_to_errors, "mind changed to a mistake")]
    {
        rows.extend(changes.iter().flat_map(|changes| rows_of_changes(changes, to)));
    }
    rows.extend(report.hesitations.iter().flat_map(rows_of_hesitations));
    rows
}

/// Name and value of what was understood of people whom the robot knows.
fn rows_of_known_people(known: &KnownPeople) -> Vec<(String, String)> {
    let row = |name: &str, value: String| (name.to_owned(), value);
    vec![
        row("goal inferred rightly, after ten reaches", proportion(&known.right)),
        row("  wrongly", proportion(&known.wrong)),
        row("  first goal that stood 50 ms was right", proportion(&known.first_right)),
        row("  wrong", proportion(&known.first_wrong)),
        row("  lead p5 p50 p95, ms", spread(known.lead_ms)),
    ]
}

/// Name and value of every metric of where the time went.
fn rows_of_time(time: &TimeReport) -> Vec<(String, String)> {
    let seconds = |spread: Option<Spread>, digits: usize| {
        let shown = |Spread { p5, p50, p95 }| format!("{p5:.digits$} {p50:.digits$} {p95:.digits$}");
        spread.map_or("-".into(), shown)
    };
    let mut rows = vec![
        ("an assembly p5 p50 p95, s".into(), seconds(time.seconds, 1)),
        ("  the person waits, s".into(), interval(time.person_waits_s, 1.0, 1, "")),
    ];
    for (who, spent) in [("person", &time.person), ("robot", &time.robot)] {
        rows.extend(spent.iter().map(|own| {
            let name = format!("    {who} {}, s", own.occupation.name());
            (name, interval(Some(own.seconds), 1.0, 1, ""))
        }));
    }
    rows.extend(time.skills.iter().map(|own| {
        let shown =
            format!("{}; longest {:.1} of {}", seconds(Some(own.seconds), 1), own.longest_s, own.count);
        (format!("  decided to done: {}, p5 p50 p95, s", own.skill.name()), shown)
    }));
    rows.extend([
        (
            "  movements over their shortest time p5 p50 p95: planned".into(),
            seconds(time.planned_over_shortest, 2),
        ),
        ("    and as made".into(), seconds(time.taken_over_shortest, 2)),
    ]);
    rows
}

/// Name and value of every metric of hesitations in mid-reach.
fn rows_of_hesitations(hesitations: &Hesitations) -> Vec<(String, String)> {
    vec![
        ("hesitated: goal inferred as the hand stops".into(), proportion(&hesitations.inferred_before)),
        ("  or later, before the grasp".into(), proportion(&hesitations.inferred)),
        ("    and from then on until it".into(), proportion(&hesitations.kept)),
        ("  rightly at grasp".into(), proportion(&hesitations.right)),
        ("  wrongly".into(), proportion(&hesitations.wrong)),
    ]
}

/// Name and value of every metric of changes of mind in mid-reach.
fn rows_of_changes(changes: &ChangesOfMind, to: &str) -> Vec<(String, String)> {
    let mut rows = vec![
        (format!("{to}: first goal inferred before the turn"), proportion(&changes.inferred_before)),
        ("  its answer decided".into(), proportion(&changes.decided_before)),
        ("  new goal inferred within 150 ms of the turn".into(), proportion(&changes.followed_in_time)),
        ("    from the turn p5 p50 p95, ms".into(), spread(changes.delay_ms)),
        (
            "    where the first goal was inferred before".into(),
            proportion(&changes.followed_in_time_of_inferred),
        ),
        ("    from the turn p5 p50 p95, ms".into(), spread(changes.delay_of_inferred_ms)),
        ("  not at grasp".into(), proportion(&changes.never_followed)),
        ("    but another one".into(), proportion(&changes.wrong)),
        ("  hand heads for the new part, from the turn p5 p50 p95, ms".into(), spread(changes.heading_ms)),
        ("    goal inferred within 150 ms of that".into(), proportion(&changes.followed_heading_in_time)),
        ("    from that p5 p50 p95, ms".into(), spread(changes.delay_after_heading_ms)),
    ];
    if changes.answered_in_time.of > 0 {
        rows.extend([
            ("  new answer decided within 150 ms of the turn".into(), proportion(&changes.answered_in_time)),
            ("    from the turn p5 p50 p95, ms".into(), spread(changes.answer_delay_ms)),
        ]);
    }
    rows
}

fn spread(spread: Option<Spread>) -> String {
    spread.map_or("-".into(), |Spread { p5, p50, p95 }| format!("{p5:.0} {p50:.0} {p95:.0}"))
}

fn proportion(proportion: &Proportion) -> String {
    let Proportion { count, of, fraction, low, high } = proportion;
    match of {
        0 => "none".into(),
        _ => {
            format!("{:.1} % ({:.1} to {:.1}), {count} of {of}", 100.0 * fraction, 100.0 * low, 100.0 * high)
        }
    }
}

fn interval(metric: Option<Estimate>, scale: f64, digits: usize, unit: &str) -> String {
    metric.map_or("-".into(), |Estimate { value, low, high, .. }| {
        let [value, low, high] = [value, low, high].map(|value| format!("{:.digits$}", scale * value));
        format!("{value}{unit} ({low} to {high})")
    })
}
