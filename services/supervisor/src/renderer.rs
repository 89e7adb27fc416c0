use crate::{Note, NoteKind};
use indicatif::{ProgressBar, ProgressStyle};
use owo_colors::{OwoColorize, Stream, Style};
use std::io::{IsTerminal, Write, stderr};
use std::time::{Duration, Instant};

/// What is shown.
#[derive(Debug)]
pub(crate) enum Line {
    /// Stays.
    Note(Note),
    /// Is replaced by the next one.
    Status(String),
    /// The end.
    Close,
}

/// Writes to the terminal, or to a file in its place.
pub(crate) struct Renderer {
    spinner: Option<ProgressBar>,
    /// When the status was written last.
    shown: Option<Instant>,
}

impl Renderer {
    /// Without a terminal the status becomes a line of its own this often: a file of a long run stays readable. Chosen by
    /// hand.
    const PLAIN_STATUS_INTERVAL: Duration = Duration::from_secs(5);

    pub(crate) fn new() -> Self {
        let spinner = stderr().is_terminal().then(ProgressBar::new_spinner);
        if let (Some(spinner), Ok(style)) =
            (&spinner, ProgressStyle::with_template("{spinner:.cyan} {wide_msg}"))
        {
            spinner.set_style(style);
        }
        Self { spinner, shown: None }
    }

    pub(crate) fn show(&mut self, line: Line) {
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
        if self.shown.is_none_or(|at| at.elapsed() >= Self::PLAIN_STATUS_INTERVAL) {
            self.shown = Some(Instant::now());
            write_line(status);
        }
    }

    pub(crate) fn close(self) {
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
    let style = match note.kind {
        NoteKind::Achieved => Style::new().green(),
        NoteKind::Decision => Style::new().cyan(),
        NoteKind::Speech => Style::new().magenta(),
        NoteKind::Disturbance => Style::new().yellow(),
        NoteKind::Alarm => Style::new().red().bold(),
        NoteKind::Plain => Style::new(),
    };
    note.text.if_supports_color(Stream::Stderr, |text| text.style(style)).to_string()
}
