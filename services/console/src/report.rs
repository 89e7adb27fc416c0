use coact_run_records::{Event, RunLog, Summary, Verdict};
use serde_json::{Value, json};
use std::path::Path;

/// How a run has ended, as a page is told it: the verdict, and how the person at the table was understood. Without a summary only that
/// it has ended.
///
/// `errors` are how many errors the network has noticed.
pub fn report(folder: &Path, at_ms: u64, errors: usize) -> Value {
    let Ok(summary) = Summary::read(folder) else {
        return json!({ "kind": "ended", "at_ms": at_ms, "verdict": null, "person": null });
    };
    let told = &summary.anticipation;
    let work = match summary.work.verdict {
        Verdict::Pass => "pass",
        Verdict::Fail => "fail",
    };
    let events = RunLog::<Event>::read(folder).unwrap_or_default();
    let done = events.iter().filter_map(Event::as_action).count();
    json!({
        "kind": "ended",
        "at_ms": at_ms,
        "verdict": {
            "work": work,
            "reasons": summary.work.reasons,
            "anticipation": format!(
                "{} actions to be answered, {} decided before the grasp, {} rightly",
                told.actions, told.decided_before_grasp, told.correct
            ),
        },
        "person": {
            "actions": done,
            "answered": told.actions,
            "understood_before_grasp": told.decided_before_grasp,
            "rightly": told.correct,
            "median_lead_ms": told.lead_ms.p50,
            "errors_noticed": errors,
            "assemblies": summary.task.assemblies,
            "achieved": summary.task.achieved,
            "subgoals": summary.task.subgoals,
        },
    })
}
