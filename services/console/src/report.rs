use coact_run_records::{Event, RunLog, Summary, Verdict, WaitEvent, Waiting};
use serde_json::{Value, json};
use std::path::Path;

/// So many of the longest waits of each are told by name.
const LONGEST: usize = 3;

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
    let waits: Vec<&WaitEvent> = events.iter().filter_map(Event::as_wait).collect();
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
        // None at all: the run is of before they were measured, or nobody has done anything.
        "waits": (!waits.is_empty()).then(|| json!({
            "person": waits_of(Waiting::Person, &waits),
            "robot": waits_of(Waiting::Robot, &waits),
        })),
    })
}

/// For how long one of the two waited for the other, when, and which waits were the longest, as a page is told it.
fn waits_of(who: Waiting, waits: &[&WaitEvent]) -> Value {
    let mut own: Vec<_> = waits.iter().filter(|wait| wait.who == who).collect();
    let spans: Vec<_> = own.iter().map(|wait| json!([wait.from_ms, wait.until_ms])).collect();
    let total: f64 = own.iter().map(|wait| wait.seconds()).sum();
    own.sort_by(|one, other| other.seconds().total_cmp(&one.seconds()));
    let longest = own
        .iter()
        .take(LONGEST)
        .map(|wait| json!({ "from_ms": wait.from_ms, "seconds": wait.seconds(), "subgoal": wait.subgoal }));
    json!({ "seconds": total, "spans_ms": spans, "longest": longest.collect::<Vec<_>>() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_waits_in_a_row_of_their_own_and_the_longest_is_named_first() {
        let wait = |who, from_ms: u64, until_ms: u64, subgoal: &str| WaitEvent {
            who,
            from_ms,
            until_ms,
            subgoal: subgoal.to_owned(),
        };
        let waits = [
            wait(Waiting::Person, 1_000, 1_500, "wheel"),
            wait(Waiting::Robot, 2_000, 9_000, "nut"),
            wait(Waiting::Person, 10_000, 12_250, "column"),
        ];
        let waits: Vec<_> = waits.iter().collect();
        let told = waits_of(Waiting::Person, &waits);
        assert_eq!(told["seconds"], 2.75);
        assert_eq!(told["spans_ms"], json!([[1_000, 1_500], [10_000, 12_250]]));
        assert_eq!(told["longest"][0], json!({ "from_ms": 10_000, "seconds": 2.25, "subgoal": "column" }));
        assert_eq!(waits_of(Waiting::Robot, &waits)["seconds"], 7.0);
    }
}
