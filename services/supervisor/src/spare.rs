use crate::{ProcessSpec, RunningChild};
use std::io::{self, Write};
use std::process::ChildStdin;
use std::time::Duration;

/// The next one of a process, started ahead: it has loaded what it needs, holds nothing of the run, and waits for its turn.
/// Dropped, it is ended.
#[derive(Debug)]
pub(crate) struct Spare {
    child: RunningChild,
    /// One byte on its standard input says that its turn has come.
    turn: ChildStdin,
    generation: u32,
}

impl Spare {
    /// From when a process is ready until its spare is started. Chosen by hand: by then the remains of its predecessor are
    /// removed, and the chain runs as it should.
    pub(crate) const AFTER: Duration = Duration::from_millis(200);

    /// Starts the spare that is to be this generation of the process.
    ///
    /// # Errors
    /// The program cannot be executed.
    pub(crate) fn start(
        spec: &ProcessSpec,
        generation: u32,
        on_line: impl FnMut(&str) + Send + 'static,
    ) -> io::Result<Self> {
        let (child, turn) = RunningChild::spawn_spare(spec, generation, on_line)?;
        Ok(Self { child, turn, generation })
    }

    /// It has died before its turn.
    pub(crate) fn is_dead(&self) -> bool {
        self.child.is_dead()
    }

    /// Makes it this generation of the process; `None` when it cannot be.
    pub(crate) fn take_turn(mut self, generation: u32, realtime: bool) -> Option<RunningChild> {
        if self.generation != generation || self.is_dead() {
            return None;
        }
        if realtime {
            self.child.promote();
        }
        self.turn.write_all(&[1]).ok()?;
        Some(self.child)
    }
}
