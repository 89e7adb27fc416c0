use crate::{SupervisorEvent, SupervisorEventKind};
use serde::{Deserialize, Serialize};

/// A time in which the robot stood because an operator wanted it to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct OperatorStopReport {
    /// When it was stopped, s after the start of the run; negative before it.
    pub at_s: f64,
    /// Who stopped it: user and process id.
    pub by: String,
    /// When it was let go on; absent when the run ended before.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub resumed_at_s: Option<f64>,
    /// Who let it go on.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub resumed_by: Option<String>,
}

impl OperatorStopReport {
    /// Of a run that started at this time, ns of `CLOCK_MONOTONIC`, from its supervisor's events.
    pub fn all(events: &[SupervisorEvent], start_ns: u64) -> Vec<Self> {
        let at_s = |event: &SupervisorEvent| (event.at_ns as f64 - start_ns as f64) / 1e9;
        let mut stops: Vec<Self> = Vec::new();
        for event in events {
            match (event.event, stops.last_mut()) {
                (SupervisorEventKind::OperatorStopped, _) => {
                    stops.push(Self {
                        at_s: at_s(event),
                        by: event.operator(),
                        resumed_at_s: None,
                        resumed_by: None,
                    });
                }
                (SupervisorEventKind::OperatorResumed, Some(stop)) => {
                    stop.resumed_at_s = Some(at_s(event));
                    stop.resumed_by = Some(event.operator());
                }
                _ => {}
            }
        }
        stops
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn event(event: SupervisorEventKind, at_ns: u64, pid: u32) -> SupervisorEvent {
        let process = SupervisorEvent::OPERATOR.into();
        SupervisorEvent {
            at_ns,
            event,
            process,
            generation: 0,
            pid,
            fault: None,
            reason: None,
            user: Some(1000),
        }
    }

    #[test]
    fn each_stop_is_told_with_who_ended_it_if_anybody_did() {
        let (stopped, resumed) = (SupervisorEventKind::OperatorStopped, SupervisorEventKind::OperatorResumed);
        let events = [
            event(stopped, 4_500_000_000, 7),
            event(resumed, 6_000_000_000, 8),
            event(SupervisorEventKind::Ready, 7_000_000_000, 9),
            event(stopped, 8_000_000_000, 10),
        ];
        let stops = OperatorStopReport::all(&events, 1_000_000_000);
        assert_eq!((stops[0].at_s, stops[0].by.as_str()), (3.5, "user 1000 (pid 7)"));
        let resumed = (stops[0].resumed_at_s, stops[0].resumed_by.as_deref());
        assert_eq!(resumed, (Some(5.0), Some("user 1000 (pid 8)")));
        assert_eq!((stops.len(), stops[1].at_s, stops[1].resumed_at_s), (2, 7.0, None));
    }
}
