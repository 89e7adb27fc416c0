use crate::{Goal, Meanings, Mistake, clauses};
use coact_joint_task::Task;
use coact_messages::{FieldFrame, LayerKind};
use coact_period::cycles;
use std::time::Duration;

/// How long a decision must have stood before it is spoken of: a change of mind is not worth a sentence. Chosen by hand.
const STANDING: u64 = cycles(Duration::from_millis(150));
/// Age of a decision in the first frame beyond which a predecessor has spoken of it already. Chosen by hand.
const OLD_NEWS: u64 = cycles(Duration::from_secs(1));
/// The same sentence is not said again for so long. Chosen by hand: about two sentences' length.
const NO_REPEAT: u64 = cycles(Duration::from_secs(5));

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
    /// Detected error.
    error: Option<Mistake>,
    /// Words that say something else than the hand does: index into `Task::chains`.
    contradiction: Option<usize>,
    /// When the youngest of them began to stand.
    since: u64,
}

impl Subject {
    fn is_about(&self, other: &Self) -> bool {
        (self.action, self.error, self.contradiction) == (other.action, other.error, other.contradiction)
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
        let error = first(&self.meanings.errors, frame, LayerKind::ErrorMonitoring);
        let contradiction = self.contradiction(frame);
        let since =
            [action.map(|action| action.since), error.map(|error| error.1), contradiction.map(|own| own.1)]
                .into_iter()
                .flatten()
                .max();
        Subject {
            action: action.map(|action| action.action as usize),
            error: error.map(|(error, _)| error),
            contradiction: contradiction.map(|(chain, _)| chain),
            since: since.unwrap_or(0),
        }
    }

    /// The chain that the person speaks of while another one is inferred, and since when both stand.
    fn contradiction(&self, frame: &FieldFrame) -> Option<(usize, u64)> {
        let (said, heard) = first(&self.meanings.words, frame, LayerKind::ActionObservation)?;
        let (goal, inferred) = first(&self.meanings.goals, frame, LayerKind::Intention)?;
        (goal.chain != said).then(|| (said, heard.max(inferred)))
    }

    /// First why (the person's goal, an error), then what.
    fn compose(&self, subject: &Subject, frame: &FieldFrame) -> Option<String> {
        let Self { task, meanings, .. } = self;
        let mut clauses = Vec::new();
        let goal = first(&meanings.goals, frame, LayerKind::Intention).map(|(goal, _)| goal);
        clauses.extend(
            subject.contradiction.zip(goal).map(|(said, goal)| clauses::contradicted(task, said, goal)),
        );
        clauses.extend(match subject.error {
            Some(Mistake::Means(kind)) => Some(clauses::at_hand(task, kind)),
            Some(Mistake::Loss(kind)) => Some(clauses::lost(task, kind)),
            Some(Mistake::Goal(_)) | None => None,
        });
        if let Some(Mistake::Goal(subgoal)) = subject.error {
            let done = peaks(frame, LayerKind::SubgoalsAchieved).map(|(index, _)| index);
            let achieved =
                done.filter(|&index| index < task.subgoals.len()).fold(0, |mask, index| mask | 1 << index);
            let available = peaks(frame, LayerKind::SubgoalsAvailable)
                .map(|(index, _)| index)
                .filter(|&index| index < task.subgoals.len())
                .collect::<Vec<_>>();
            let meant = goal.filter(|goal| goal.subgoal == subgoal);
            clauses.push(clauses::objected(task, subgoal, meant, achieved, &available));
        }
        if let Some(action) = subject.action {
            let answered = |goal: &Goal| task.complement(goal.chain, goal.subgoal) == Some(action);
            clauses.extend(goal.filter(answered).map(|goal| clauses::inferred(task, goal)));
            clauses.extend(clauses::announced(task, &task.actions[action]));
        }
        (!clauses.is_empty()).then(|| clauses.join(" "))
    }
}

/// What the first standing peak of a layer stands for, and since when it stands.
fn first<T: Copy>(meanings: &[Option<T>], frame: &FieldFrame, layer: LayerKind) -> Option<(T, u64)> {
    peaks(frame, layer).find_map(|(index, since)| Some(((*meanings.get(index)?)?, since)))
}

/// Populations of a layer that hold a peak, and since when.
fn peaks(frame: &FieldFrame, layer: LayerKind) -> impl Iterator<Item = (usize, u64)> {
    let since = frame.populations(layer).map(|population| frame.since[population]);
    since.enumerate().filter(|&(_, since)| since != 0)
}
