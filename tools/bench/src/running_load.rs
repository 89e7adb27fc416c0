use crate::{BenchError, Load};
use rustix::process::{Pid, Signal, kill_process};
use std::io::ErrorKind;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A load that lasts until it is dropped.
#[derive(Debug)]
pub struct RunningLoad {
    child: Child,
}

/// stress-ng ends its workers within this, or is killed.
const ENDS_WITHIN: Duration = Duration::from_secs(5);

impl RunningLoad {
    /// Starts a load, if there is one to be started. It ends by itself after `longest`, whatever becomes of this program.
    ///
    /// # Errors
    /// [`BenchError::NoStress`], or [`BenchError::Load`].
    pub fn start(load: Load, longest: Duration) -> Result<Option<Self>, BenchError> {
        let Some(arguments) = load.arguments() else { return Ok(None) };
        let mut command = Command::new("stress-ng");
        command.arg("--quiet").arg("--timeout").arg(format!("{}s", longest.as_secs().max(1))).args(arguments);
        command.current_dir(std::env::temp_dir());
        let started = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
        match started {
            Ok(child) => Ok(Some(Self { child })),
            Err(error) if error.kind() == ErrorKind::NotFound => Err(BenchError::NoStress(load.name())),
            Err(error) => Err(BenchError::Load(error)),
        }
    }
}

impl Drop for RunningLoad {
    fn drop(&mut self) {
        // It ends its workers when it is told to, not when it is killed.
        let told = kill_process(Pid::from_child(&self.child), Signal::TERM);
        let begin = Instant::now();
        while told.is_ok() && begin.elapsed() < ENDS_WITHIN {
            if !matches!(self.child.try_wait(), Ok(None)) {
                return;
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        self.child.kill().ok();
        self.child.wait().ok();
    }
}
