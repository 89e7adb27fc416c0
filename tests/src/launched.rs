use crate::{Finished, TIMEOUT, checkout, coact, wait_within};
use coact_pipeline::Run;
use rustix::process::{Pid, Signal, kill_process};
use std::fs::File;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::rc::Rc;
use std::time::{Duration, Instant};

/// A killed process is dead after this time. Chosen by hand: the kernel gives back its locked memory first, some milliseconds.
const DYING: Duration = Duration::from_secs(20);

/// A running `coact launch`.
#[derive(Debug)]
pub struct Launched {
    child: Child,
    folder: Rc<tempfile::TempDir>,
}

impl Launched {
    /// `coact launch` with these arguments and a report folder of its own.
    pub fn start(arguments: &[&str]) -> Self {
        Self::start_by(Command::new(coact()), arguments)
    }

    /// The same, by a command that ends in the program `coact`: under another user's limits, for example.
    pub fn start_by(mut command: Command, arguments: &[&str]) -> Self {
        let folder = Rc::new(tempfile::tempdir().unwrap());
        let file = |name: &str| Stdio::from(File::create(folder.path().join(name)).unwrap());
        command.arg("launch").arg("--report").arg(folder.path().join("report")).args(arguments);
        command.current_dir(checkout()).stdin(Stdio::null()).stdout(file("stdout")).stderr(file("stderr"));
        Self { child: command.spawn().unwrap(), folder }
    }

    /// Kills the supervisor, and waits until it is dead.
    pub fn kill(&mut self) {
        self.signal(Signal::KILL);
        wait_within(TIMEOUT, "the supervisor's death", || self.child.try_wait().unwrap());
    }

    /// A successor of the supervisor, which was killed: `coact adopt` with these arguments.
    pub fn adopt(&mut self, arguments: &[&str]) {
        let file = |name: &str| Stdio::from(File::create(self.folder.path().join(name)).unwrap());
        let mut command = Command::new(coact());
        command.arg("adopt").args(arguments).current_dir(checkout());
        command.stdin(Stdio::null()).stdout(file("stdout")).stderr(file("stderr"));
        self.child = command.spawn().unwrap();
    }

    /// Its run, once it has been made.
    pub fn run(&mut self) -> Run {
        self.run_within(TIMEOUT)
    }

    fn run_within(&mut self, most: Duration) -> Run {
        let report = self.report();
        wait_within(most, "the run's directory", || {
            self.assert_lives();
            Run::all().into_iter().find(|run| run.settings().report == report)
        })
    }

    /// Its run, once all processes are ready and its clock runs.
    pub fn when_started(&mut self) -> Run {
        self.when_started_within(TIMEOUT)
    }

    /// The same, but it must take no longer than this.
    pub fn when_started_within(&mut self, most: Duration) -> Run {
        let run = self.run_within(most);
        wait_within(most, "the run's start", || {
            self.assert_lives();
            run.start_ns().unwrap_or_default()
        });
        run
    }

    /// Who waits for something of it does not wait on when it has ended.
    fn assert_lives(&mut self) {
        if let Some(status) = self.child.try_wait().unwrap() {
            panic!("ended with {status}:\n{}", self.said());
        }
    }

    /// Sends a signal to the supervisor.
    pub fn signal(&self, signal: Signal) {
        kill_process(Pid::from_child(&self.child), signal).unwrap();
    }

    /// What it has said on standard error so far.
    pub fn said(&self) -> String {
        std::fs::read_to_string(self.folder.path().join("stderr")).unwrap_or_default()
    }

    /// Waits for its end.
    pub fn finish(self) -> Finished {
        self.finish_within(TIMEOUT)
    }

    /// Waits for its end, which must come within this time.
    pub fn finish_within(mut self, most: Duration) -> Finished {
        let status = wait_within(most, "the end of the run", || self.child.try_wait().unwrap());
        let read = |name: &str| std::fs::read_to_string(self.folder.path().join(name)).unwrap_or_default();
        Finished::read(&self.report(), status.code(), read("stdout"), read("stderr"))
    }

    /// Its report folder. It is there as long as this or [`Launched::folder`] is.
    pub fn report(&self) -> PathBuf {
        self.folder.path().join("report")
    }

    /// What keeps its report folder beyond its end.
    pub fn folder(&self) -> Rc<tempfile::TempDir> {
        self.folder.clone()
    }
}

impl Drop for Launched {
    fn drop(&mut self) {
        // A test that failed leaves no set behind: the supervisor's children die with it.
        self.child.kill().ok();
        // Bounded: a process that cannot die must not make a test hang.
        let begin = Instant::now();
        while matches!(self.child.try_wait(), Ok(None)) && begin.elapsed() < DYING {
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}
