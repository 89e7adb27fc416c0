use std::time::Duration;

/// A line for the person at the terminal, and what its colour means.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// What it is about.
    pub tone: Tone,
    /// The line.
    pub text: String,
}

/// What a line is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// Something was achieved: green.
    Achieved,
    /// The robot decided: cyan.
    Decision,
    /// The robot speaks: magenta.
    Speech,
    /// A process died and is replaced, or a fault was injected: yellow.
    Disturbance,
    /// Something that spoils the run or its figures: red.
    Alarm,
    /// Anything else: plain.
    Plain,
}

impl Note {
    /// A note.
    pub fn new(tone: Tone, text: impl Into<String>) -> Self {
        Self { tone, text: text.into() }
    }

    /// The same, with the run's time in front.
    pub fn at(self, elapsed: Duration) -> Self {
        Self { text: format!("{:>6.1} s  {}", elapsed.as_secs_f64(), self.text), ..self }
    }
}
