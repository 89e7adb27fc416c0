use crate::{ProcessSpec, StderrTail};
use coact_pipeline::{GENERATION_VARIABLE, ProcessStat, Ready};
use coact_realtime::{RequestedFault, SchedulingClass};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{Mode, OFlags};
use rustix::process::{
    Pid, PidfdFlags, Resource, Rlimit, Signal, WaitId, WaitIdOptions, getrlimit, pidfd_open,
    pidfd_send_signal, prlimit, set_parent_process_death_signal, waitid,
};
use rustix::thread::{sched_getaffinity, sched_setaffinity};
use std::fs::File;
use std::io::{self, Read};
use std::os::fd::{AsFd, AsRawFd, BorrowedFd, OwnedFd};
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::Path;
use std::process::{ChildStdin, Command, ExitStatus, Stdio};
use std::thread;
use std::time::Duration;

/// A running process, to be watched, signalled and reaped.
///
/// It is a child, or was one of a predecessor of the supervisor. Dropped, it is killed and reaped: however the supervisor ends,
/// it leaves no process behind. When the supervisor itself is killed or panics, the kernel kills the process
/// ([parent-death signal][1]), unless that can be adopted.
///
/// [1]: https://man7.org/linux/man-pages/man2/PR_SET_PDEATHSIG.2const.html
#[derive(Debug)]
pub struct RunningChild {
    pid: Pid,
    /// False of a process that a predecessor of the supervisor started: its exit status goes to whoever reaps it.
    is_child: bool,
    /// Becomes readable when nothing of the process is left. Unlike a process id, it never comes to mean another process.
    pidfd: OwnedFd,
    /// Becomes readable when its sentinel has ended, if it has one: it does nothing from then on, but gives its memory back for
    /// milliseconds.
    sentinel: Option<OwnedFd>,
    stderr: StderrTail,
}

impl RunningChild {
    /// Starts the program of `spec` as this generation of the process; `on_line` gets each line that it writes to standard
    /// error.
    ///
    /// # Errors
    /// The program cannot be executed.
    pub fn spawn(
        spec: &ProcessSpec,
        generation: u32,
        on_line: impl FnMut(&str) + Send + 'static,
    ) -> io::Result<Self> {
        let mut command = Command::new(&spec.program);
        command.args(&spec.arguments).env(GENERATION_VARIABLE, generation.to_string()).stdin(Stdio::null());
        Ok(Self::of(command, spec.realtime, on_line)?.0)
    }

    /// The same as a spare, in no hurry: it waits until it can read a byte from its standard input, whose other end is
    /// returned.
    ///
    /// # Errors
    /// As [`RunningChild::spawn`].
    pub(crate) fn spawn_spare(
        spec: &ProcessSpec,
        generation: u32,
        on_line: impl FnMut(&str) + Send + 'static,
    ) -> io::Result<(Self, ChildStdin)> {
        let mut command = Command::new(&spec.program);
        command.args(&spec.arguments).arg("--spare");
        command.env(GENERATION_VARIABLE, generation.to_string()).stdin(Stdio::piped());
        let (child, stdin) = Self::of(command, false, on_line)?;
        Ok((child, stdin.ok_or(io::ErrorKind::BrokenPipe)?))
    }

    /// Starts it, in the supervisor's scheduling class if `realtime`.
    fn of(
        mut command: Command,
        realtime: bool,
        on_line: impl FnMut(&str) + Send + 'static,
    ) -> io::Result<(Self, Option<ChildStdin>)> {
        command.stdout(Stdio::null()).stderr(Stdio::piped());
        // A group of its own: Ctrl-C in the terminal reaches the supervisor alone, which stops the set in order.
        command.process_group(0);
        let supervisor = rustix::process::getpid();
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
        let stderr = StderrTail::follow(stderr, on_line);
        Ok((Self { pid, is_child: true, pidfd, sentinel: None, stderr }, child.stdin.take()))
    }

    /// The process that reported this to a predecessor of the supervisor; `None` when it is dead, whatever process has its id now.
    pub fn adopt(ready: &Ready, on_line: impl FnMut(&str) + Send + 'static) -> Option<Self> {
        let pid = Pid::from_raw(ready.pid.cast_signed())?;
        let pidfd = pidfd_open(pid, PidfdFlags::empty()).ok()?;
        // Looked at when the descriptor is open: that cannot come to mean another process.
        if ProcessStat::of(ready.pid).ok()?.started != ready.started
            || waits_for_death(&pidfd, Some(&NO_TIME))
        {
            return None;
        }
        let stderr: Box<dyn Read + Send> = match File::open(format!("/proc/{}/fd/2", ready.pid)) {
            Ok(pipe) => Box::new(pipe),
            Err(error) => {
                tracing::warn!("what {} writes to standard error is lost: {error}", ready.process);
                Box::new(io::empty())
            }
        };
        let stderr = StderrTail::follow(stderr, on_line);
        let mut adopted = Self { pid, is_child: false, pidfd, sentinel: None, stderr };
        adopted.watch_sentinel(ready.sentinel);
        Some(adopted)
    }

    /// Lets its death be noticed by that of the thread with this id, if it is one of its threads.
    pub(crate) fn watch_sentinel(&mut self, thread: u32) {
        // Linux before 6.9 has no descriptors of threads.
        let flags = PidfdFlags::from_bits_retain(libc::PIDFD_THREAD);
        let opened = Pid::from_raw(thread.cast_signed()).and_then(|thread| pidfd_open(thread, flags).ok());
        // Looked at when the descriptor is open: that cannot come to mean another thread.
        let is_its_own = || Path::new(&format!("/proc/{}/task/{thread}", self.pid())).exists();
        self.sentinel = opened.filter(|_| is_its_own());
    }

    /// Its process id.
    pub fn pid(&self) -> u32 {
        self.pid.as_raw_nonzero().get().cast_unsigned()
    }

    /// Readable once the process is dead.
    pub fn death(&self) -> BorrowedFd<'_> {
        self.sentinel.as_ref().unwrap_or(&self.pidfd).as_fd()
    }

    /// Sends a signal. It is no error that the process is dead already: its death is noticed in any case.
    pub fn signal(&self, signal: Signal) {
        if let Err(error) = pidfd_send_signal(&self.pidfd, signal)
            && error != rustix::io::Errno::SRCH
        {
            tracing::warn!("process {}: cannot send {signal:?}: {error}", self.pid());
        }
    }

    /// Requests that it does a fault to itself. As with [`RunningChild::signal`], it may be dead already.
    pub(crate) fn request(&self, fault: RequestedFault) {
        // rustix sends no real-time signals, which belong to libc.
        // SAFETY: a system call with a descriptor that is open, a number, and no pointer to anything.
        let sent = unsafe {
            libc::syscall(libc::SYS_pidfd_send_signal, self.pidfd.as_raw_fd(), fault.signal(), 0, 0)
        };
        let error = io::Error::last_os_error();
        if sent != 0 && error.raw_os_error() != Some(libc::ESRCH) {
            tracing::warn!("process {}: cannot request {fault:?}: {error}", self.pid());
        }
    }

    /// Lets the kernel grant it no file handle any more; those that it has stay. As with [`RunningChild::signal`], it may be dead.
    pub(crate) fn refuse_handles(&self) {
        let maximum = getrlimit(Resource::Nofile).maximum;
        let limited = prlimit(Some(self.pid), Resource::Nofile, Rlimit { current: Some(0), maximum });
        if let Err(error) = limited
            && error != rustix::io::Errno::SRCH
        {
            tracing::warn!("process {}: cannot limit its file handles: {error}", self.pid());
        }
    }

    /// Gives it the class of a real-time process that starts: its turn has come. Not granted, it keeps its class.
    pub(crate) fn promote(&self) {
        SchedulingClass::STARTING.apply_to(self.pid()).ok();
    }

    /// Makes it an ordinary process, on the supervisor's own cores: killed, it then gives back its memory, which takes
    /// milliseconds, without keeping others from theirs. Not granted, it keeps its class.
    pub(crate) fn demote(&self) {
        SchedulingClass::Other.apply_to(self.pid()).ok();
        if let Ok(cores) = sched_getaffinity(None) {
            sched_setaffinity(Some(self.pid), &cores).ok();
        }
    }

    /// Whether a signal has stopped it (SIGSTOP, SIGTTIN): it does nothing until somebody continues it.
    pub fn is_stopped(&self) -> bool {
        if !self.is_child {
            return ProcessStat::of(self.pid()).is_ok_and(|stat| stat.is_stopped);
        }
        let stopped = WaitIdOptions::STOPPED | WaitIdOptions::NOWAIT | WaitIdOptions::NOHANG;
        waitid(WaitId::PidFd(self.pidfd.as_fd()), stopped).is_ok_and(|status| status.is_some())
    }

    /// Whether its main thread runs, or would if it had a core.
    pub(crate) fn is_runnable(&self) -> bool {
        ProcessStat::of(self.pid()).is_ok_and(|stat| stat.is_runnable)
    }

    /// Whether its main thread sleeps until something wakes it.
    pub(crate) fn is_asleep(&self) -> bool {
        ProcessStat::of(self.pid()).is_ok_and(|stat| stat.is_asleep)
    }

    /// The time that its main thread has computed for, to some milliseconds; `None` when it is dead, or the kernel does not tell.
    ///
    /// Not the process's: a background thread that computes says nothing about the one that pulses.
    pub fn computed(&self) -> Option<Duration> {
        let told = std::fs::read_to_string(format!("/proc/{}/schedstat", self.pid())).ok()?;
        Some(Duration::from_nanos(told.split_ascii_whitespace().next()?.parse().ok()?))
    }

    /// Whether it has ended: it does nothing any more, but may still have its memory.
    pub fn is_dead(&self) -> bool {
        poll(&mut [PollFd::from_borrowed_fd(self.death(), PollFlags::IN)], Some(&NO_TIME)) == Ok(1)
    }

    /// Whether nothing is left of it.
    pub(crate) fn is_gone(&self) -> bool {
        waits_for_death(&self.pidfd, Some(&NO_TIME))
    }

    /// Waits until nothing is left of one that is dead: some milliseconds.
    pub(crate) fn wait_until_gone(&self) {
        // An interrupting signal ends no wait, and a supervisor that may have no file handles cannot wait: it looks again.
        while !waits_for_death(&self.pidfd, None) {
            thread::sleep(LOOKS_AGAIN);
        }
    }

    /// How it ended, once it is dead; `None` when another supervisor had started it. It is reaped when this is dropped.
    pub fn exit_status(&self) -> Option<ExitStatus> {
        if !self.is_child {
            return None;
        }
        // Parents are told as soon as nothing is left of it.
        let told = if self.is_gone() { None } else { ProcessStat::of(self.pid()).ok() };
        if let Some(stat) = told {
            return Some(ExitStatus::from_raw(stat.exit_code));
        }
        let status = waitid(WaitId::PidFd(self.pidfd.as_fd()), WaitIdOptions::EXITED | WaitIdOptions::NOWAIT);
        let status = status.ok().flatten()?;
        // As wait(2) encodes it: a status in the second byte, or a signal in the first.
        let code = status.exit_status().map(|code| (code & 0xff) << 8);
        Some(ExitStatus::from_raw(code.or(status.terminating_signal()).unwrap_or_default()))
    }

    /// How long the rest of a dead process's standard error may take to arrive. The reader only has to empty a pipe; chosen
    /// by hand, short enough not to delay the replacement.
    const STDERR_TIMEOUT: Duration = Duration::from_millis(50);

    /// Its last lines on standard error, with those that are still on their way.
    pub fn stderr_tail(&self) -> Vec<String> {
        self.stderr.last_lines(Self::STDERR_TIMEOUT)
    }
}

impl Drop for RunningChild {
    fn drop(&mut self) {
        // A supervisor that panics ends as a killed one does: what drives the arm brakes, and who can be adopted lives on.
        if std::thread::panicking() {
            return;
        }
        let (is_dead, pid) = (self.is_dead(), self.pid);
        self.signal(Signal::KILL);
        if !self.is_child {
            // Who took it over from the dead supervisor reaps it. An interrupting signal ends no wait.
            if !is_dead {
                self.wait_until_gone();
            }
            return;
        }
        // The replacement of a dead one does not wait for its reaping.
        let reaper = std::thread::Builder::new().name("reaper".into());
        match reaper.spawn(move || reap(pid)) {
            Ok(reaping) if !is_dead => drop(reaping.join()),
            Ok(_) => {}
            Err(_) => reap(pid),
        }
    }
}

/// How long a wait that was ended by something else waits before it looks again. Chosen by hand; not sensitive.
const LOOKS_AGAIN: Duration = Duration::from_millis(1);
const NO_TIME: Timespec = Timespec { tv_sec: 0, tv_nsec: 0 };

/// Whether the process is dead before the time is over; without a limit, also false when a signal interrupts.
fn waits_for_death(pidfd: &OwnedFd, limit: Option<&Timespec>) -> bool {
    poll(&mut [PollFd::new(pidfd, PollFlags::IN)], limit) == Ok(1)
}

/// Reaps a process that is dead or dying, as an ordinary thread: the kernel waits, spinning, for whoever reads the process's entries
/// in /proc just then, and on one core a reader would never get on beside a real-time thread that spins.
fn reap(pid: Pid) {
    let before = SchedulingClass::current();
    let _ = SchedulingClass::Other.apply();
    let _ = rustix::io::retry_on_intr(|| waitid(WaitId::Pid(pid), WaitIdOptions::EXITED));
    let _ = before.apply();
}

/// In the forked child: has it killed when `supervisor` dies, also if it died just now; makes it ordinary unless `realtime`; and
/// lets it write when nobody reads.
fn prepare(supervisor: Pid, realtime: bool) -> io::Result<()> {
    if !realtime {
        // Refused only to a thread that never had another class.
        let _ = SchedulingClass::Other.apply();
    }
    set_parent_process_death_signal(Some(Signal::KILL))?;
    if rustix::process::getppid() != Some(supervisor) {
        return Err(io::ErrorKind::NotFound.into());
    }
    // With a reading end of its own the pipe is never broken: to write an error that nobody hears is no reason to die.
    if let Ok(both) = rustix::fs::open(c"/proc/self/fd/2", OFlags::RDWR, Mode::empty()) {
        rustix::stdio::dup2_stderr(&both)?;
    }
    Ok(())
}
