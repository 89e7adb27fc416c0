use crate::Note;
use crate::renderer::{Line, Renderer};
use std::sync::mpsc::{Sender, channel};
use std::thread::JoinHandle;

/// Shows notes and status on standard error, from a thread of its own: a terminal that blocks delays nobody.
#[derive(Debug)]
pub struct Terminal {
    lines: Sender<Line>,
    writer: Option<JoinHandle<()>>,
}

/// Shows notes from elsewhere, as long as the terminal is open; clonable.
#[derive(Debug, Clone)]
pub struct Notes(Sender<Line>);

impl Notes {
    /// Shows a note.
    pub fn show(&self, note: Note) {
        // The thread is gone only when the run is over.
        self.0.send(Line::Note(note)).ok();
    }
}

impl Terminal {
    /// Starts the thread.
    pub fn open() -> Self {
        let (lines, incoming) = channel();
        let writer = std::thread::spawn(move || {
            let mut renderer = Renderer::new();
            for line in incoming.iter().take_while(|line| !matches!(line, Line::Close)) {
                renderer.show(line);
            }
            renderer.close();
        });
        Self { lines, writer: Some(writer) }
    }

    /// To show notes from elsewhere.
    pub fn notes(&self) -> Notes {
        Notes(self.lines.clone())
    }

    /// Shows a note.
    pub fn note(&self, note: Note) {
        self.send(Line::Note(note));
    }

    /// Shows the state of the run in one line.
    pub fn status(&self, status: String) {
        self.send(Line::Status(status));
    }

    fn send(&self, line: Line) {
        self.lines.send(line).ok();
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        self.send(Line::Close);
        if let Some(writer) = self.writer.take() {
            writer.join().ok();
        }
    }
}
