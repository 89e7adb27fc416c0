use crate::{ProcessSpec, StderrTail, scheduling};
use coact_pipeline::GENERATION_VARIABLE;
use rustix::process::{
    Pid, PidfdFlags, Signal, pidfd_open, pidfd_send_signal, set_parent_process_death_signal,
};
use std::io;
use std::os::fd::{AsFd, BorrowedFd, OwnedFd};
use std::os::unix::process::CommandExt;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::Duration;

/// A running process: what it takes to watch, signal and reap it.
///
/// Dropped, it is killed and reaped: no path out of the supervisor leaves a process behind. Should the supervisor
/// itself be killed, the kernel kills the process ([parent-death signal][1]).
///
/// [1]: https://man7.org/linux/man-pages/man2/PR_SET_PDEATHSIG.2const.html
#[derive(Debug)]
pub struct RunningChild {
    child: Child,
    /// Becomes readable at the very moment of death; immune to the reuse of process ids.
    pidfd: OwnedFd,
    stderr: StderrTail,
}

impl RunningChild {
    /// Starts the program of `spec` for the `generation`-th time after the first; each line that it writes to standard error goes to `pass_on`.
    ///
    /// # Errors
    /// The program cannot be executed.
    pub fn spawn(
        spec: &ProcessSpec,
        generation: u32,
        pass_on: impl FnMut(&str) + Send + 'static,
    ) -> io::Result<Self> {
        let mut command = Command::new(&spec.program);
        command.args(&spec.arguments).env(GENERATION_VARIABLE, generation.to_string());
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
        // A group of its own: Ctrl-C in the terminal reaches the supervisor alone, which stops the set in order.
        command.process_group(0);
        let (supervisor, realtime) = (rustix::process::getpid(), spec.realtime);
        // SAFETY: between fork and exec only async-signal-safe system calls are made, and nothing is allocated.
        unsafe { command.pre_exec(move || prepare(supervisor, realtime)) };
        let mut child = command.spawn()?;
        let pid = Pid::from_child(&child);
        let pidfd = match pidfd_open(pid, PidfdFlags::empty()) {
            Ok(pidfd) => pidfd,
            Err(error) => {
                child.kill()?;
                child.wait()?;
                return Err(error.into());
            }
        };
        let stderr = child.stderr.take().ok_or(io::ErrorKind::BrokenPipe)?;
        Ok(Self { child, pidfd, stderr: StderrTail::follow(stderr, pass_on) })
    }

    /// Its process id.
    pub fn pid(&self) -> u32 {
        self.child.id()
    }

    /// Readable once the process is dead.
    pub fn death(&self) -> BorrowedFd<'_> {
        self.pidfd.as_fd()
    }

    /// Sends a signal. That it is dead already is no error: the death is reported on its own way.
    pub fn signal(&self, signal: Signal) {
        if let Err(error) = pidfd_send_signal(&self.pidfd, signal)
            && error != rustix::io::Errno::SRCH
        {
            tracing::warn!("process {}: cannot send {signal:?}: {error}", self.pid());
        }
    }

    /// How it ended, if it did; reaps it.
    pub fn ended(&mut self) -> Option<ExitStatus> {
        self.child.try_wait().ok().flatten()
    }

    /// Its last lines on standard error; waits a moment for the rest when it has just died.
    pub fn last_words(&self) -> Vec<String> {
        self.stderr.last_lines(Duration::from_millis(50))
    }
}

impl Drop for RunningChild {
    fn drop(&mut self) {
        // Both fail only when it was reaped before.
        drop(self.child.kill());
        drop(self.child.wait());
    }
}

/// In the forked child: be killed when `supervisor` dies, also when it just did; be ordinary unless `realtime`.
fn prepare(supervisor: Pid, realtime: bool) -> io::Result<()> {
    if !realtime {
        scheduling::stand_down();
    }
    set_parent_process_death_signal(Some(Signal::KILL))?;
    if rustix::process::getppid() != Some(supervisor) {
        return Err(io::ErrorKind::NotFound.into());
    }
    Ok(())
}
