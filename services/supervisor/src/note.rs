use crate::NoteKind;
use std::time::Duration;

/// A line for the person at the terminal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// What it is about.
    pub kind: NoteKind,
    /// The line.
    pub text: String,
}

impl Note {
    /// A note.
    pub fn new(kind: NoteKind, text: impl Into<String>) -> Self {
        Self { kind, text: text.into() }
    }

    /// The same, with the run's time in front.
    pub fn at(self, elapsed: Duration) -> Self {
        Self { text: format!("{:>6.1} s  {}", elapsed.as_secs_f64(), self.text), ..self }
    }
}
