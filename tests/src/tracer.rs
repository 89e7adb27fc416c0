use nix::errno::Errno;
use nix::sys::ptrace::{self, Options};
use nix::sys::wait::{WaitPidFlag, WaitStatus, waitpid};
use nix::unistd::Pid;
use std::time::{Duration, Instant};
use syscalls::Sysno;

/// Sees the system calls of one thread of another process, as a debugger does.
///
/// No wait of it is without an end, and whatever fails, the thread goes on untraced: [`Drop`] lets go of it, and if that is not
/// possible in time, the kernel does when the tracing thread ends.
#[derive(Debug)]
pub struct Tracer {
    thread: Pid,
    stopped: bool,
}

/// Why a thread is not traced, or not any more.
#[derive(Debug, thiserror::Error)]
pub enum TraceError {
    /// The machine grants no tracing.
    #[error("tracing is not permitted")]
    NotPermitted,
    /// The thread has ended.
    #[error("the traced thread has ended: {0}")]
    Ended(String),
    /// The time is over.
    #[error("the traced thread did not stop in time")]
    Late,
    /// The kernel refused something else.
    #[error("tracing: {0}")]
    Refused(#[from] Errno),
}

/// A thread that is told to stop does so within this, unless it or the machine hangs.
const STOPS_WITHIN: Duration = Duration::from_secs(2);

impl Tracer {
    /// Begins to trace.
    ///
    /// # Errors
    /// [`TraceError`].
    pub fn attach(thread: u32) -> Result<Self, TraceError> {
        let thread = Pid::from_raw(thread as i32);
        ptrace::seize(thread, Options::PTRACE_O_TRACESYSGOOD).map_err(|error| match error {
            Errno::EPERM | Errno::EACCES | Errno::ENOSYS => TraceError::NotPermitted,
            Errno::ESRCH => TraceError::Ended("before it was traced".into()),
            other => other.into(),
        })?;
        let mut tracer = Self { thread, stopped: false };
        tracer.interrupt()?;
        Ok(tracer)
    }

    /// All system calls that the thread begins within `span`.
    ///
    /// # Errors
    /// [`TraceError`].
    pub fn calls(&mut self, span: Duration) -> Result<Vec<Sysno>, TraceError> {
        let (mut calls, end) = (Vec::new(), Instant::now() + span);
        let mut signal = None;
        while Instant::now() < end {
            ptrace::syscall(self.thread, signal.take())?;
            self.stopped = false;
            match self.wait(Instant::now() + STOPS_WITHIN)? {
                WaitStatus::PtraceSyscall(_) => calls.extend(self.begun()?),
                // A signal of the thread's own: it gets it.
                WaitStatus::Stopped(_, own) => signal = Some(own),
                _ => {}
            }
        }
        Ok(calls)
    }

    /// The system call that the stopped thread begins; none when it ends one.
    fn begun(&self) -> Result<Option<Sysno>, TraceError> {
        let info = ptrace::syscall_info(self.thread)?;
        if info.op != nix::libc::PTRACE_SYSCALL_INFO_ENTRY {
            return Ok(None);
        }
        // SAFETY: of the union the kernel has filled what `op` says.
        let number = unsafe { info.u.entry.nr };
        Ok(Sysno::new(number as usize))
    }

    fn interrupt(&mut self) -> Result<(), TraceError> {
        ptrace::interrupt(self.thread)?;
        self.wait(Instant::now() + STOPS_WITHIN).map(drop)
    }

    /// Looks until the thread stops. It does not sleep, so that the thread is not delayed for longer than need be.
    fn wait(&mut self, until: Instant) -> Result<WaitStatus, TraceError> {
        loop {
            match waitpid(self.thread, Some(WaitPidFlag::WNOHANG | WaitPidFlag::__WALL))? {
                WaitStatus::StillAlive if Instant::now() > until => return Err(TraceError::Late),
                WaitStatus::StillAlive => std::thread::yield_now(),
                ended @ (WaitStatus::Exited(..) | WaitStatus::Signaled(..)) => {
                    return Err(TraceError::Ended(format!("{ended:?}")));
                }
                stopped => {
                    self.stopped = true;
                    return Ok(stopped);
                }
            }
        }
    }
}

impl Drop for Tracer {
    fn drop(&mut self) {
        // Only a stopped thread can be let go of; one that has ended needs it no more.
        if self.stopped || self.interrupt().is_ok() {
            ptrace::detach(self.thread, None).ok();
        }
    }
}
