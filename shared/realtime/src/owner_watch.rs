use coact_pipeline::{Membership, ProcessEntry, Run};
use rustix::process::{Signal, getpid, kill_process};
use std::fs::{File, OpenOptions};
use std::io::Read;
use std::os::unix::fs::{FileTypeExt, OpenOptionsExt};
use std::time::{Duration, Instant};

/// Watches, on an ordinary thread of a process, whether its run has a supervisor. When that one dies, the process lives on for a
/// bounded time, in which a successor can adopt the run; when nobody does, it ends by itself.
#[derive(Debug)]
pub(crate) struct OwnerWatch {
    run: Run,
    adoptable_for: Duration,
    stop_grace: Duration,
    /// While it is held, nobody takes the run for remains.
    _member: Membership,
}

impl OwnerWatch {
    /// How often an orphaned process looks for a successor. Chosen by hand: what nobody supervises has time.
    const LOOK_EVERY: Duration = Duration::from_millis(50);

    pub(crate) fn new(run: &Run, adoptable_for: Duration, entry: &ProcessEntry, member: Membership) -> Self {
        Self { run: run.clone(), adoptable_for, stop_grace: entry.stop_grace, _member: member }
    }

    /// Watches for ever: for the death of one supervisor after another.
    pub(crate) fn watch(self) -> ! {
        loop {
            let generation = self.run.owner().map_or(0, |owner| owner.generation);
            // Without a directory there is no supervisor either.
            self.run.wait_for_death_of_owner().ok();
            if !self.is_adopted(generation) {
                self.end();
            }
        }
    }

    /// Waits for a successor of the supervisor of this generation; false when none has come in time.
    fn is_adopted(&self, generation: u32) -> bool {
        // What has not begun cannot be gone on with.
        let has_begun = self.run.start_ns().is_ok_and(|start| start.is_some());
        let limit = if has_begun { self.adoptable_for } else { Duration::ZERO };
        let (since, mut said) = (Instant::now(), Said::open());
        while !self.run.owner().is_ok_and(|owner| owner.generation > generation) {
            if since.elapsed() >= limit {
                return false;
            }
            std::thread::sleep(Self::LOOK_EVERY);
            said.make_room();
        }
        true
    }

    /// Requests that the process ends, as its supervisor would, and kills it when it does not.
    fn end(&self) -> ! {
        kill_process(getpid(), Signal::TERM).ok();
        std::thread::sleep(self.stop_grace);
        kill_process(getpid(), Signal::KILL).ok();
        loop {
            std::thread::park();
        }
    }
}

/// What the process has written to standard error and nobody has read: a pipe that must never be full, for who writes would
/// wait.
struct Said(Option<File>);

impl Said {
    /// Of the 64 KiB that a pipe holds, so many may wait for a successor to read them. Chosen by hand.
    const MOST: u64 = 32 << 10;

    /// Opens the pipe's other end. It is there: the process itself has it open for reading, too.
    fn open() -> Self {
        let file = OpenOptions::new().read(true).custom_flags(libc::O_NONBLOCK).open("/proc/self/fd/2");
        let is_pipe = |file: &File| file.metadata().is_ok_and(|metadata| metadata.file_type().is_fifo());
        Self(file.ok().filter(is_pipe))
    }

    /// Forgets the oldest when there is too much.
    fn make_room(&mut self) {
        let Some(pipe) = &mut self.0 else { return };
        while rustix::io::ioctl_fionread(&*pipe).is_ok_and(|waiting| waiting > Self::MOST) {
            // A successor that is there already reads it, too: then there is nothing left.
            if pipe.read(&mut [0; 4096]).is_err() {
                return;
            }
        }
    }
}
