use crate::Seen;
use coact_joint_task::{NetworkPlan, Task};
use coact_messages::LayerKind;
use coact_period::PERIOD_NS;
use coact_run_records::{
    ActionEvent, Event, FaultEvent, LogFollower, RecordError, SupervisorEvent, SupervisorEventKind,
    WaitEvent, Waiting,
};
use coact_supervisor::{NoteKind, RunProgress};
use serde_json::{Value, json};
use std::path::Path;

/// What has happened in a run, event after event, in the order in which it became known: from the logs that monitor and supervisor
/// write, from the peaks of the network, and from what the person was heard to say.
#[derive(Debug)]
pub struct Timeline {
    events: Vec<Value>,
    log: LogFollower<Event>,
    supervisor: LogFollower<SupervisorEvent>,
    progress: RunProgress,
    plan: NetworkPlan,
    /// When cycle 0 began, ns of `CLOCK_MONOTONIC`.
    start_ns: u64,
    /// Cycles since which the peaks stand that were told already, by population.
    told: Vec<u64>,
    /// Sentences of the person that were told already.
    heard: u64,
}

/// Layers whose peaks are events of their own: what is inferred, and what is found to be wrong. Decisions are in the monitor's log.
const TOLD: [(LayerKind, &str, &str); 2] =
    [(LayerKind::Intention, "inferred", "infers: "), (LayerKind::ErrorMonitoring, "error", "notices: ")];
/// A goal that stood so long before the onset, or came so long after the grasp, belongs to another action, ms.
const BELONGS: (u64, u64) = (1000, 300);

impl Timeline {
    /// Of a run that reports there, and whose cycle 0 began then.
    pub fn new(report: &Path, task: &Task, plan: &NetworkPlan, start_ns: u64) -> Self {
        Self {
            events: Vec::new(),
            log: LogFollower::new(report),
            supervisor: LogFollower::new(report),
            progress: RunProgress::new(task),
            plan: plan.clone(),
            start_ns,
            told: vec![0; plan.populations.len()],
            heard: 0,
        }
    }

    /// All events so far.
    pub fn events(&self) -> &[Value] {
        &self.events
    }

    /// How many errors the network has noticed.
    pub fn errors(&self) -> usize {
        self.events.iter().filter(|event| event["sort"] == "error").count()
    }

    /// Adds what the newest messages tell.
    pub fn watch(&mut self, seen: &Seen) {
        if let Some(frame) = seen.frame {
            for (layer, sort, word) in TOLD {
                for population in self.plan.layer(layer).populations.clone() {
                    let since = frame.since[population];
                    if since > 0 && since != std::mem::replace(&mut self.told[population], since) {
                        let text = format!("{word}{}", self.plan.meaning(population).label);
                        self.events.push(json!({ "sort": sort, "at_ms": since, "text": text }));
                    }
                }
            }
        }
        let Some(heard) = seen.sample.map(|sample| &sample.heard) else { return };
        if heard.sentences != self.heard {
            self.heard = heard.sentences;
            let text = format!("\u{201c}{}\u{201d}", heard.sentence());
            self.events.push(json!({ "sort": "heard", "at_ms": heard.cycle, "text": text }));
        }
    }

    /// Adds what the logs have got since the last call.
    ///
    /// # Errors
    /// A log cannot be read, or is damaged.
    pub fn read_logs(&mut self) -> Result<(), RecordError> {
        for event in self.log.news()? {
            let told = self.of_event(event);
            self.events.extend(told);
        }
        for event in self.supervisor.news()? {
            let told = self.of_supervisor(&event);
            self.events.extend(told);
        }
        Ok(())
    }

    fn of_event(&self, event: Event) -> Option<Value> {
        let (sort, at_ms, text) = match event {
            Event::Action(action) => return Some(self.of_action(&action)),
            Event::Wait(wait) => return Some(of_wait(&wait)),
            Event::Fault(fault) => return Some(self.of_fault(&fault)),
            Event::Blind { from_ms, until_ms } => {
                let text = "the monitor saw nothing";
                return Some(
                    json!({ "sort": "blind", "at_ms": from_ms, "until_ms": until_ms, "text": text }),
                );
            }
            Event::Subgoal { at_ms, name, .. } => ("achieved", at_ms, name),
            // The board shows it as it rises; what each does is seen.
            Event::Perceived { .. } | Event::Span(_) => return None,
            Event::Assembly { at_ms, completed } => {
                ("assembly", at_ms, format!("assembly {completed} is complete"))
            }
            Event::Forgotten { at_ms, name } => ("forgotten", at_ms, format!("forgotten: {name}")),
            Event::Decision { at_ms, action } => ("decision", at_ms, action),
            Event::Utterance { at_ms, text } => ("said", at_ms, format!("\u{201c}{text}\u{201d}")),
        };
        Some(json!({ "sort": sort, "at_ms": at_ms, "text": text }))
    }

    fn of_action(&self, action: &ActionEvent) -> Value {
        let ActionEvent { onset_ms, grasp_ms, decided_ms, lead_ms, decided, expected, correct, .. } = action;
        let span = onset_ms.saturating_sub(BELONGS.0)..=grasp_ms + BELONGS.1;
        let newest = |sort: &str| {
            let is_near = |event: &Value| event["at_ms"].as_u64().is_some_and(|at| span.contains(&at));
            self.events.iter().rev().find(|event| event["sort"] == sort && is_near(event))
        };
        let (inferred, error) = (newest("inferred"), newest("error"));
        json!({
            "sort": "action",
            "at_ms": onset_ms,
            "onset_ms": onset_ms,
            "grasp_ms": grasp_ms,
            "text": format!("{}: {}", action.chain, if action.subgoal.is_empty() { &action.kind } else { &action.subgoal }),
            "inferred_ms": inferred.map(|event| event["at_ms"].clone()),
            "inferred": inferred.map(|event| event["text"].clone()),
            "decision_ms": decided_ms,
            "decision": decided,
            "lead_ms": lead_ms,
            "right": expected.as_ref().map(|_| *correct),
            "error": error.map(|event| event["text"].clone()),
        })
    }

    fn of_fault(&self, fault: &FaultEvent) -> Value {
        let at_ms = self.cycle(fault.at_ns);
        let recovered = match fault.recovered_ms {
            Some(ms) => format!("good again after {ms:.1} ms"),
            None => "no good output since".to_owned(),
        };
        let until_ms = at_ms + fault.recovered_ms.unwrap_or_default().ceil() as u64;
        let text = format!("{}: {}, {recovered}", fault.process, fault.fault);
        json!({ "sort": "fault", "at_ms": at_ms, "until_ms": until_ms, "text": text })
    }

    fn of_supervisor(&mut self, event: &SupervisorEvent) -> Option<Value> {
        self.progress.event(event);
        let note = self.progress.take_notes().pop()?;
        let sort = match (event.event, note.kind) {
            (SupervisorEventKind::OperatorStopped, _) => "stopped",
            (SupervisorEventKind::OperatorResumed, _) => "resumed",
            (SupervisorEventKind::Ready, _) => "restart",
            (_, NoteKind::Alarm) => "alarm",
            _ => "fault",
        };
        Some(json!({ "sort": sort, "at_ms": self.cycle(event.at_ns), "text": note.text }))
    }

    fn cycle(&self, ns: u64) -> u64 {
        ns.saturating_sub(self.start_ns) / PERIOD_NS
    }
}

fn of_wait(wait: &WaitEvent) -> Value {
    let who = match wait.who {
        Waiting::Robot => "the robot waits for you",
        Waiting::Person => "you wait for the robot",
    };
    let of = if wait.subgoal.is_empty() { "" } else { ": " };
    let text = format!("{who}{of}{} ({:.1} s)", wait.subgoal, wait.seconds());
    json!({ "sort": "wait", "who": wait.who, "at_ms": wait.from_ms, "until_ms": wait.until_ms, "text": text })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use coact_messages::{FieldFrame, SensorSample};
    use coact_run_records::RunLog;
    use std::path::PathBuf;

    fn timeline(report: &Path) -> Timeline {
        let task = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        let (task, plan) = NetworkPlan::load(&task).unwrap();
        Timeline::new(report, &task, &plan, 5_000_000)
    }

    #[test]
    fn a_peak_and_a_sentence_are_told_once_and_an_action_knows_what_was_inferred_of_it() {
        let report = tempfile::tempdir().unwrap();
        let mut timeline = timeline(report.path());
        let goal = timeline.plan.layer(LayerKind::Intention).populations.start;
        let mut frame: Box<FieldFrame> = bytemuck::zeroed_box();
        let mut sample: Box<SensorSample> = bytemuck::zeroed_box();
        frame.since[goal] = 1200;
        (sample.heard.sentences, sample.heard.cycle, sample.heard.length) = (1, 1300, 2);
        sample.heard.text[..2].copy_from_slice(b"hi");
        for _ in 0..3 {
            timeline.watch(&Seen { frame: Some(&frame), sample: Some(&sample), ..Seen::default() });
        }
        let sorts = |timeline: &Timeline| -> Vec<String> {
            timeline.events().iter().map(|event| event["sort"].as_str().unwrap().to_owned()).collect()
        };
        assert_eq!(sorts(&timeline), ["inferred", "heard"]);
        let action = ActionEvent {
            action: 1,
            chain: "insert".into(),
            kind: "wheel".into(),
            subgoal: "wheel on the person's side".into(),
            onset_ms: 1000,
            grasp_ms: 1600,
            decided_ms: Some(1250),
            lead_ms: Some(350),
            decided: Some("steady the base".into()),
            expected: Some("steady the base".into()),
            correct: true,
        };
        RunLog::open(report.path()).unwrap().append(vec![Event::Action(action)]).unwrap();
        timeline.read_logs().unwrap();
        timeline.read_logs().unwrap();
        let told = timeline.events().last().unwrap();
        assert_eq!(sorts(&timeline).len(), 3);
        assert_eq!((told["inferred_ms"].as_u64(), told["lead_ms"].as_i64()), (Some(1200), Some(350)));
        assert_eq!(told["text"], "insert: wheel on the person's side");
    }

    #[test]
    fn what_the_supervisor_did_stands_at_the_cycle_in_which_it_was_done() {
        let report = tempfile::tempdir().unwrap();
        let mut timeline = timeline(report.path());
        let died = SupervisorEvent {
            at_ns: 5_000_000 + 7 * PERIOD_NS,
            event: SupervisorEventKind::Died,
            process: "fields".into(),
            generation: 0,
            pid: 42,
            fault: None,
            reason: Some("killed by SIGKILL".into()),
            user: None,
        };
        RunLog::open(report.path()).unwrap().append(vec![died]).unwrap();
        timeline.read_logs().unwrap();
        let told = timeline.events().last().unwrap();
        assert_eq!((told["sort"].as_str(), told["at_ms"].as_u64()), (Some("fault"), Some(7)));
        assert!(told["text"].as_str().unwrap().contains("SIGKILL"));
    }
}
