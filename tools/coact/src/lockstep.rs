//! `coact launch --lockstep`: the same stages in this process, with the same progress and report.

use anyhow::Result;
use coact_monitor::Monitor;
use coact_period::{CYCLES_PER_SECOND, PERIOD_NS, seconds};
use coact_supervisor::{Launch, Note, NoteKind, RunProgress, Terminal};
use std::time::Duration;

/// Runs all stages to the end of the run.
///
/// # Errors
/// A file or setting is refused, or the report cannot be written.
pub fn run(launch: &Launch) -> Result<()> {
    let Launch { settings, task, .. } = launch;
    Monitor::clear(&settings.report)?;
    let terminal = Terminal::open();
    let mut progress = RunProgress::new(task);
    let finished = coact_lockstep::run(settings, settings.duration, |stages, sentence| {
        let at = Duration::from_nanos(stages.ticks() * PERIOD_NS);
        progress.frame(&stages.frame);
        if let Some(sentence) = sentence {
            progress.says(&sentence.text);
        }
        for note in progress.take_notes() {
            terminal.note(note.at(at));
        }
        if stages.ticks().is_multiple_of(CYCLES_PER_SECOND) {
            terminal.status(progress.status(at));
        }
    })?;
    let (run, taken) = (seconds(finished.ticks), finished.elapsed.as_secs_f64());
    let text = format!("{run:.1} s in {taken:.1} s: {:.1} times real time", run / taken);
    terminal.note(Note::new(NoteKind::Plain, text));
    Ok(())
}
