use crate::{Goal, Meanings, sentence};
use coact_joint_task::Task;
use coact_messages::{FieldFrame, LayerKind};

/// How long a decision must have stood before it is spoken of, cycles: a change of mind is not worth a sentence.
const STANDING: u64 = 150;
/// A decision that is older than this in the first frame was spoken of by a predecessor, cycles.
const OLD_NEWS: u64 = 1000;
/// The same sentence is not said again for so long, cycles.
const NO_REPEAT: u64 = 5000;

/// Watches the fields and finds the words.
#[derive(Debug)]
pub struct Voice {
    task: Task,
    meanings: Meanings,
    /// What was spoken of last; none before the first frame.
    spoken: Option<Subject>,
    /// Sentences of late.
    said: Vec<Sentence>,
}

/// Something to say.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sentence {
    /// Cycle of the field frame that it was composed from.
    pub cycle: u64,
    /// The words.
    pub text: String,
}

/// What a sentence is about.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct Subject {
    /// The robot's decision: index into `Task::actions`.
    action: Option<usize>,
    /// Detected error: index into `Task::subgoals`.
    error: Option<usize>,
    /// When the younger of both began to stand.
    since: u64,
}

impl Subject {
    fn is_about(&self, other: &Self) -> bool {
        (self.action, self.error) == (other.action, other.error)
    }
}

impl Voice {
    /// For a task and its network.
    pub fn new(task: &Task, meanings: Meanings) -> Self {
        Self { task: task.clone(), meanings, spoken: None, said: Vec::new() }
    }

    /// Looks at a frame; gives a sentence when there is something new to say.
    pub fn observe(&mut self, frame: &FieldFrame) -> Option<Sentence> {
        if frame.task != self.task.fingerprint {
            return None;
        }
        let (cycle, subject) = (frame.header.cycle, self.subject(frame));
        let age = cycle.saturating_sub(subject.since);
        let spoken = self.spoken.get_or_insert(if age > OLD_NEWS { subject } else { Subject::default() });
        if spoken.is_about(&subject) || age < STANDING {
            return None;
        }
        *spoken = subject;
        let text = self.compose(&subject, frame)?;
        self.said.retain(|sentence| cycle.saturating_sub(sentence.cycle) < NO_REPEAT);
        if self.said.iter().any(|sentence| sentence.text == text) {
            return None;
        }
        let sentence = Sentence { cycle, text };
        self.said.push(sentence.clone());
        Some(sentence)
    }

    fn subject(&self, frame: &FieldFrame) -> Subject {
        let action = self.task.actions.get(frame.decision.action as usize).map(|_| frame.decision);
        let peak = peaks(frame, LayerKind::ErrorMonitoring).next();
        let error = peak.and_then(|(index, since)| Some(((*self.meanings.errors.get(index)?)?, since)));
        let since = action.map_or(0, |action| action.since).max(error.map_or(0, |(_, since)| since));
        let action = action.map(|action| action.action as usize);
        Subject { action, error: error.map(|(subgoal, _)| subgoal), since }
    }

    /// First why (the person's goal, an error), then what.
    fn compose(&self, subject: &Subject, frame: &FieldFrame) -> Option<String> {
        let Self { task, meanings, .. } = self;
        let mut clauses = Vec::new();
        if let Some(subgoal) = subject.error {
            let achieved = peaks(frame, LayerKind::SubgoalsAchieved).any(|(index, _)| index == subgoal);
            let available = peaks(frame, LayerKind::SubgoalsAvailable)
                .map(|(index, _)| index)
                .filter(|&index| index < task.subgoals.len())
                .collect::<Vec<_>>();
            clauses.push(sentence::objected(task, subgoal, achieved, &available));
        }
        if let Some(action) = subject.action {
            let goals = peaks(frame, LayerKind::Intention);
            let mut goals = goals.filter_map(|(index, _)| meanings.goals.get(index).copied().flatten());
            let answered = |goal: &Goal| task.complement(goal.chain, goal.subgoal) == Some(action);
            clauses.extend(goals.find(answered).map(|goal| sentence::inferred(task, goal)));
            clauses.extend(sentence::announced(task, &task.actions[action]));
        }
        (!clauses.is_empty()).then(|| clauses.join(" "))
    }
}

/// Populations of a layer that hold a peak, and since when.
fn peaks(frame: &FieldFrame, layer: LayerKind) -> impl Iterator<Item = (usize, u64)> {
    let since = frame.populations(layer).map(|population| frame.since[population]);
    since.enumerate().filter(|&(_, since)| since != 0)
}
