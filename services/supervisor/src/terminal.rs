use crate::{Note, Tone};
use indicatif::{ProgressBar, ProgressStyle};
use owo_colors::{OwoColorize, Stream, Style};
use std::io::{IsTerminal, Write, stderr};
use std::sync::mpsc::{Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Shows notes and status on standard error, from a thread of its own: a terminal that stands still, holds up nobody.
#[derive(Debug)]
pub struct Terminal {
    lines: Sender<Line>,
    writer: Option<JoinHandle<()>>,
}

/// What is shown.
#[derive(Debug)]
enum Line {
    /// Stays.
    Note(Note),
    /// Is replaced by the next one.
    Status(String),
    /// The end.
    Close,
}

/// A clonable way to show notes.
#[derive(Debug, Clone)]
pub struct Notes(Sender<Line>);

impl Notes {
    /// Shows a note.
    pub fn show(&self, note: Note) {
        // Nobody listens any more only when the run is over.
        self.0.send(Line::Note(note)).ok();
    }
}

impl Terminal {
    /// Without a terminal the status becomes a line of its own so often.
    const PLAIN_STATUS_EVERY: Duration = Duration::from_secs(5);

    /// Begins to show.
    pub fn open() -> Self {
        let (lines, incoming) = channel();
        let writer = std::thread::spawn(move || {
            let mut screen = Screen::open();
            for line in incoming.iter().take_while(|line| !matches!(line, Line::Close)) {
                screen.show(line);
            }
            screen.close();
        });
        Self { lines, writer: Some(writer) }
    }

    /// A way to show notes from elsewhere, as long as the terminal is open.
    pub fn notes(&self) -> Notes {
        Notes(self.lines.clone())
    }

    /// Shows a note.
    pub fn note(&self, note: Note) {
        self.send(Line::Note(note));
    }

    /// Shows how the run stands.
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

/// The terminal itself, or a file in its place.
struct Screen {
    spinner: Option<ProgressBar>,
    shown: Option<Instant>,
}

impl Screen {
    fn open() -> Self {
        let spinner = stderr().is_terminal().then(ProgressBar::new_spinner);
        if let (Some(spinner), Ok(style)) =
            (&spinner, ProgressStyle::with_template("{spinner:.cyan} {wide_msg}"))
        {
            spinner.set_style(style);
        }
        Self { spinner, shown: None }
    }

    fn show(&mut self, line: Line) {
        match (line, &self.spinner) {
            (Line::Note(note), Some(spinner)) => spinner.println(painted(&note)),
            (Line::Note(note), None) => write_line(&painted(&note)),
            (Line::Status(status), Some(spinner)) => {
                spinner.set_message(status);
                spinner.tick();
            }
            (Line::Status(status), None) => self.show_plain(&status),
            (Line::Close, _) => {}
        }
    }

    fn show_plain(&mut self, status: &str) {
        if self.shown.is_none_or(|at| at.elapsed() >= Terminal::PLAIN_STATUS_EVERY) {
            self.shown = Some(Instant::now());
            write_line(status);
        }
    }

    fn close(self) {
        if let Some(spinner) = self.spinner {
            spinner.finish_and_clear();
        }
    }
}

/// A closed standard error is no reason to stop a robot.
fn write_line(line: &str) {
    writeln!(stderr(), "{line}").ok();
}

fn painted(note: &Note) -> String {
    let style = match note.tone {
        Tone::Achieved => Style::new().green(),
        Tone::Decision => Style::new().cyan(),
        Tone::Speech => Style::new().magenta(),
        Tone::Disturbance => Style::new().yellow(),
        Tone::Alarm => Style::new().red().bold(),
        Tone::Plain => Style::new(),
    };
    note.text.if_supports_color(Stream::Stderr, |text| text.style(style)).to_string()
}
