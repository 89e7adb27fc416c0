use crate::{Note, NoteKind};
use coact_joint_task::Task;
use coact_messages::{FieldFrame, LayerKind, Pulse, Refusal, Speech, topic};
use coact_run_records::{SupervisorEvent, SupervisorEventKind};
use std::collections::BTreeMap;
use std::time::Duration;

/// The state of the run, as the person at the terminal sees it; each change becomes a [`Note`].
#[derive(Debug)]
pub struct RunProgress {
    task: Task,
    /// Bit i is set when subgoal i is achieved.
    achieved: u64,
    decision: Option<usize>,
    /// What the pulses of each process counted: deadline misses, of its dead generations and of the present one, and ignored
    /// messages.
    missed: BTreeMap<String, PulseCounts>,
    restarts: u32,
    /// An operator has stopped the robot.
    stopped: bool,
    notes: Vec<Note>,
}

#[derive(Debug, Default)]
struct PulseCounts {
    /// In generations that are dead.
    before: u64,
    generation: u32,
    now: u64,
    /// For which reasons it has ignored messages, in any generation.
    refused: [bool; Refusal::COUNT],
}

/// A population whose signal is above this stands for an achieved subgoal: the middle between rest (0) and a full peak (1).
const ACHIEVED: f64 = 0.5;

impl RunProgress {
    /// Of a run of this task, at its beginning.
    pub fn new(task: &Task) -> Self {
        Self {
            task: task.clone(),
            achieved: 0,
            decision: None,
            missed: BTreeMap::new(),
            restarts: 0,
            stopped: false,
            notes: Vec::new(),
        }
    }

    /// The newest field frame: achieved subgoals and decision.
    pub fn frame(&mut self, frame: &FieldFrame) {
        let populations = frame.populations(LayerKind::SubgoalsAchieved);
        let mut now = 0;
        // Behind the subgoals stand the choices.
        for (index, (population, subgoal)) in populations.zip(&self.task.subgoals).enumerate() {
            let bit = u64::from(frame.signal[population] > ACHIEVED) << index;
            if bit & !self.achieved != 0 {
                self.notes.push(Note::new(NoteKind::Achieved, format!("achieved: {}", subgoal.name)));
            }
            now |= bit;
        }
        self.achieved = now;
        self.decided(usize::try_from(frame.decision.action).ok());
    }

    fn decided(&mut self, action: Option<usize>) {
        let action = action.filter(|&index| index < self.task.actions.len());
        if let (Some(index), true) = (action, action != self.decision) {
            self.notes
                .push(Note::new(NoteKind::Decision, format!("decides: {}", self.task.actions[index].name)));
        }
        self.decision = action;
    }

    /// A message of what the robot says.
    pub fn speech(&mut self, speech: &Speech) {
        self.says(speech.sentence());
    }

    /// The robot says this sentence.
    pub fn says(&mut self, sentence: &str) {
        self.notes.push(Note::new(NoteKind::Speech, format!("says: \u{201c}{sentence}\u{201d}")));
    }

    /// The newest pulse of a process.
    pub fn pulse(&mut self, process: &str, pulse: &Pulse) {
        if !self.missed.contains_key(process) {
            self.missed.insert(process.to_owned(), PulseCounts::default());
        }
        let Some(missed) = self.missed.get_mut(process) else { return };
        if pulse.header.generation != missed.generation {
            missed.before += missed.now;
            missed.generation = pulse.header.generation;
        }
        missed.now = pulse.missed;
        for (reason, (known, count)) in Refusal::ALL.iter().zip(missed.refused.iter_mut().zip(pulse.refused))
        {
            if count > 0 && !*known {
                *known = true;
                let topic =
                    topic::ALL.get(pulse.refused_topic as usize).map_or("a topic", |entry| entry.name);
                let text = format!("{process} ignores a message of {topic}: {}", reason.name());
                self.notes.push(Note::new(NoteKind::Alarm, text));
            }
        }
    }

    /// Something that happened to a process.
    pub fn event(&mut self, event: &SupervisorEvent) {
        let SupervisorEvent { process, pid, generation, .. } = event;
        let fault = event.fault.as_deref().unwrap_or("fault");
        let reason = event.reason.as_deref().unwrap_or("no reason known");
        let (kind, text) = match event.event {
            SupervisorEventKind::Started
            | SupervisorEventKind::StopRequested
            | SupervisorEventKind::Stopped => return,
            SupervisorEventKind::Ready if *generation == 0 => return,
            SupervisorEventKind::Ready => {
                (NoteKind::Achieved, format!("{process} is back (restart {generation})"))
            }
            SupervisorEventKind::Died => {
                (NoteKind::Disturbance, format!("{process} died: {reason} (pid {pid})"))
            }
            SupervisorEventKind::Injected | SupervisorEventKind::InjectedLatent => {
                (NoteKind::Disturbance, format!("injecting {fault} into {process}"))
            }
            SupervisorEventKind::GaveUp => (NoteKind::Alarm, format!("{process} is given up: {reason}")),
            SupervisorEventKind::StateDropped => {
                (NoteKind::Alarm, format!("{process} begins anew: {reason}"))
            }
            SupervisorEventKind::Restarted => {
                self.restarts += 1;
                return;
            }
            SupervisorEventKind::Adopted => {
                (NoteKind::Disturbance, format!("the run was adopted by {}", event.operator()))
            }
            SupervisorEventKind::OperatorStopped => {
                self.stopped = true;
                (NoteKind::Alarm, format!("stopped by {}; coact resume lets it go on", event.operator()))
            }
            SupervisorEventKind::OperatorResumed => {
                self.stopped = false;
                (NoteKind::Achieved, format!("may go on, says {}", event.operator()))
            }
        };
        self.notes.push(Note::new(kind, text));
    }

    /// A note from elsewhere.
    pub fn note(&mut self, note: Note) {
        self.notes.push(note);
    }

    /// Every subgoal is achieved that the plan asks for.
    pub fn all_achieved(&self) -> bool {
        self.task.is_complete(self.achieved)
    }

    /// What has changed since the last call.
    pub fn take_notes(&mut self) -> Vec<Note> {
        std::mem::take(&mut self.notes)
    }

    /// The run in one line.
    pub fn status(&self, elapsed: Duration) -> String {
        let reached = self.achieved.count_ones();
        let missed: u64 = self.missed.values().map(|missed| missed.before + missed.now).sum();
        let decision = self.decision.map_or("no decision", |index| &self.task.actions[index].name);
        let stopped = if self.stopped { "  STOPPED (coact resume)" } else { "" };
        format!(
            "{:>6.1} s{stopped}  subgoals {reached}/{}  missed {missed}  restarts {}  {decision}",
            elapsed.as_secs_f64(),
            self.task.needed(self.achieved),
            self.restarts
        )
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use coact_messages::NONE;

    fn progress() -> RunProgress {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config/tasks/toy-vehicle.toml");
        RunProgress::new(&Task::load(file.as_ref()).unwrap())
    }

    /// A frame whose subgoal populations have these signals.
    fn frame(signals: &[f64], action: u32) -> Box<FieldFrame> {
        let mut frame: Box<FieldFrame> = bytemuck::zeroed_box();
        frame.layers.count = 1;
        frame.layers.kind[0] = LayerKind::SubgoalsAchieved as u32;
        frame.layers.populations[0] = signals.len() as u32;
        frame.signal[..signals.len()].copy_from_slice(signals);
        frame.decision.action = action;
        frame
    }

    fn texts(progress: &mut RunProgress) -> Vec<String> {
        progress.take_notes().into_iter().map(|note| note.text).collect()
    }

    #[test]
    fn each_achieved_subgoal_and_each_new_decision_is_told_once() {
        let mut progress = progress();
        let (subgoal, action) =
            (progress.task.subgoals[1].name.clone(), progress.task.actions[2].name.clone());
        for _ in 0..3 {
            progress.frame(&frame(&[0.4, 0.9], 2));
        }
        assert_eq!(texts(&mut progress), [format!("achieved: {subgoal}"), format!("decides: {action}")]);
        assert!(!progress.all_achieved());
        progress.frame(&frame(&[0.4, 0.9], NONE));
        assert_eq!(texts(&mut progress), [""; 0]);
        progress.frame(&frame(&[0.4, 0.9], 2));
        assert_eq!(texts(&mut progress), [format!("decides: {action}")]);
    }

    #[test]
    fn all_is_achieved_when_every_population_is_above_threshold() {
        let mut progress = progress();
        let count = progress.task.subgoals.len();
        progress.frame(&frame(&vec![0.6; count], NONE));
        assert!(progress.all_achieved());
        progress.frame(&frame(&vec![0.0; count], NONE));
        assert!(!progress.all_achieved(), "the scene was laid out again");
    }

    #[test]
    fn misses_of_a_dead_generation_still_count() {
        let mut progress = progress();
        for (generation, missed) in [(0, 3), (0, 5), (1, 0), (1, 2)] {
            let mut pulse = Pulse { missed, ..Pulse::default() };
            pulse.header.generation = generation;
            progress.pulse("fields", &pulse);
        }
        progress.pulse("world", &Pulse { missed: 1, ..Pulse::default() });
        assert!(progress.status(Duration::ZERO).contains("missed 8"), "{}", progress.status(Duration::ZERO));
    }

    #[test]
    fn the_status_says_that_an_operator_has_stopped_the_robot_until_it_may_go_on() {
        let mut progress = progress();
        let mut event = SupervisorEvent {
            at_ns: 5,
            event: SupervisorEventKind::OperatorStopped,
            process: SupervisorEvent::OPERATOR.into(),
            generation: 0,
            pid: 42,
            fault: None,
            reason: None,
            user: Some(1000),
        };
        progress.event(&event);
        assert!(progress.status(Duration::ZERO).contains("STOPPED"));
        event.event = SupervisorEventKind::OperatorResumed;
        progress.event(&event);
        assert!(!progress.status(Duration::ZERO).contains("STOPPED"));
        let expected = [
            "stopped by user 1000 (pid 42); coact resume lets it go on",
            "may go on, says user 1000 (pid 42)",
        ];
        assert_eq!(texts(&mut progress), expected);
    }

    #[test]
    fn each_reason_for_which_a_process_ignores_messages_is_told_once() {
        let mut progress = progress();
        let mut pulse = Pulse { refused_topic: 0, ..Pulse::default() };
        for count in 0..3 {
            pulse.refused[Refusal::Future as usize] = count;
            progress.pulse("perception", &pulse);
        }
        pulse.header.generation = 1;
        progress.pulse("perception", &pulse);
        assert_eq!(texts(&mut progress), ["perception ignores a message of coact/sensors: from the future"]);
    }
}
