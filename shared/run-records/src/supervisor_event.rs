use crate::Record;
use serde::{Deserialize, Serialize};

/// One line of the supervisor log, `supervisor.jsonl`: what happened to a process, or what an operator did, and when.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct SupervisorEvent {
    /// When it was seen or done: ns of `CLOCK_MONOTONIC`. Of a death: detection. Of an injection: just before it.
    pub at_ns: u64,
    /// What happened.
    pub event: SupervisorEventKind,
    /// Name of the process; `operator` for what an operator did to the whole set.
    pub process: String,
    /// How often the process had been restarted before.
    pub generation: u32,
    /// Process id. Of an operator: of the program that made the request.
    pub pid: u32,
    /// Name of the injected fault, if one was.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub fault: Option<String>,
    /// Why: how it died, why it was given up.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<String>,
    /// Of an operator: the user's id.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub user: Option<u32>,
}

impl SupervisorEvent {
    /// What stands for an operator in the place of a process.
    pub const OPERATOR: &'static str = "operator";

    /// Of an operator: who it was, in words.
    pub fn operator(&self) -> String {
        let user = self.user.map_or("an operator".into(), |user| format!("user {user}"));
        format!("{user} (pid {})", self.pid)
    }
}

impl Record for SupervisorEvent {
    const FILE: &'static str = "supervisor.jsonl";
}

/// What may happen to a process.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum SupervisorEventKind {
    /// Started for the first time.
    Started,
    /// Reported ready.
    Ready,
    /// Found dead.
    Died,
    /// Started again after a death.
    Restarted,
    /// To be started again without its checkpoint, because a replacement died of it.
    StateDropped,
    /// Not started again: the restart intensity is exhausted.
    GaveUp,
    /// About to get a fault injected.
    Injected,
    /// About to get a fault injected that takes effect later, when what it breaks is needed: the process dies of it then.
    InjectedLatent,
    /// Requested to end, because the run ends: nothing is due from it any more.
    StopRequested,
    /// Ended because the run ended.
    Stopped,
    /// The supervisor had died, and another one has taken its place: an operator started it.
    Adopted,
    /// An operator stopped the robot: it brakes, and stands until it may go on.
    OperatorStopped,
    /// An operator let it go on.
    OperatorResumed,
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn what_is_not_known_of_an_event_is_left_out_of_its_line() {
        let started = SupervisorEvent {
            at_ns: 5,
            event: SupervisorEventKind::Started,
            process: "fields".into(),
            generation: 0,
            pid: 7,
            fault: None,
            reason: None,
            user: None,
        };
        let line = serde_json::to_string(&started).unwrap();
        assert_eq!(line, r#"{"at_ns":5,"event":"started","process":"fields","generation":0,"pid":7}"#);
        let kind = SupervisorEventKind::GaveUp;
        let given_up = SupervisorEvent { event: kind, reason: Some("why".into()), ..started };
        let line = serde_json::to_string(&given_up).unwrap();
        assert!(line.contains(r#""event":"gave_up""#), "{line}");
        assert_eq!(serde_json::from_str::<SupervisorEvent>(&line).unwrap(), given_up);
        let kind = SupervisorEventKind::OperatorStopped;
        let stopped = SupervisorEvent { event: kind, reason: None, user: Some(1000), ..given_up };
        let line = serde_json::to_string(&stopped).unwrap();
        assert!(line.contains(r#""event":"operator_stopped""#) && line.contains(r#""user":1000"#), "{line}");
    }
}
