use crate::evidence::Ending;
use crate::private_mounts::PrivateMounts;
use crate::{Setup, Trouble};
use coact_pipeline::Run;
use coact_run_records::{LogFollower, SupervisorEvent, SupervisorEventKind};
use coact_table_edit::TableEdit;
use rustix::process::{Pid, Resource, Rlimit, Signal, getrlimit, kill_process, prlimit};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// A set of real processes, started as a person starts it.
#[derive(Debug)]
pub(crate) struct RunningSet {
    child: Child,
    // Before the folder, for one of them may lie there.
    mounts: Option<PrivateMounts>,
    folder: tempfile::TempDir,
    run: Run,
    log: LogFollower<SupervisorEvent>,
    seen: Vec<SupervisorEvent>,
}

/// How often something that is waited for is looked at: more often than the buffers of a viewer fill.
pub(crate) const POLL: Duration = Duration::from_millis(4);
/// Within so long a run has a directory.
const MADE_WITHIN: Duration = Duration::from_secs(20);
/// Within so long a set has ended: longer than the graces of all its processes.
const ENDS_WITHIN: Duration = Duration::from_secs(20);
/// Within so long nothing of a set runs whose supervisor was killed: the arm brakes, and each process ends.
const GONE_WITHIN: Duration = Duration::from_secs(3);
/// For longer than it takes until there is a successor.
const ADOPTABLE_S: f64 = 20.0;
/// Longer than any cells of one run take.
const DURATION_S: &str = "900";

impl RunningSet {
    /// `coact launch`, as soon as its run has a directory; with shared memory and a place for the report that nobody else sees,
    /// if they are to be `private`: the calling thread then sees nothing else either, as long as it lives. One that is to be
    /// `adoptable` outlives its supervisor for a while.
    pub(crate) fn launch(setup: &Setup, private: bool, adoptable: bool) -> Result<Self, Trouble> {
        let made = match &setup.kept {
            Some(kept) => tempfile::tempdir_in(kept),
            None => tempfile::tempdir(),
        };
        let folder = made.map_err(|error| Trouble::because("no folder was made")(&error))?;
        let mut mounts = if private { Some(PrivateMounts::of_this_thread()?) } else { None };
        if let Some(mounts) = &mut mounts {
            mounts.mount(Path::new("/dev/shm"))?;
            mounts.mount(folder.path())?;
        }
        let begin = || -> Result<_, Box<dyn std::error::Error>> {
            let file = |name: &str| File::create(folder.path().join(name)).map(Stdio::from);
            let (stdout, stderr) = (file("stdout")?, file("stderr")?);
            let report = report_of(folder.path());
            let mut command = Command::new(&setup.coact);
            command.arg("launch").arg("--report").arg(&report);
            command.args([
                "--world",
                world(setup),
                "--duration",
                DURATION_S,
                "--seed",
                &setup.seed.to_string(),
            ]);
            if adoptable {
                let table = TableEdit::of(&setup.configuration)?;
                let table = table.with("supervision", "adoptable_for_s", ADOPTABLE_S)?;
                command.arg("--pipeline").arg(table.write(folder.path())?);
            }
            let child = command.stdin(Stdio::null()).stdout(stdout).stderr(stderr).spawn()?;
            Ok((child, report))
        };
        let (mut child, report) = begin().map_err(|error| Trouble::because("no set was started")(&*error))?;
        let Some(run) = find(&report) else {
            child.kill().ok();
            child.wait().ok();
            let said = std::fs::read_to_string(folder.path().join("stderr")).unwrap_or_default();
            return Err(Trouble(format!("no run was made within {} s: {said}", MADE_WITHIN.as_secs())));
        };
        Ok(Self { child, mounts, folder, run, log: LogFollower::new(&report), seen: Vec::new() })
    }

    pub(crate) fn run(&self) -> &Run {
        &self.run
    }

    /// What the run, which has ended, left stays under this name, beside where it was written to, in place of what an earlier run left there. Of
    /// one that was private nothing can.
    pub(crate) fn keep(self, name: &str) -> std::io::Result<()> {
        if self.mounts.is_some() {
            return Ok(());
        }
        let named = self.folder.path().with_file_name(name);
        match std::fs::remove_dir_all(&named) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(error),
            _ => std::fs::rename(self.folder.path(), named),
        }
    }

    /// Where the run reports to, and nothing else is.
    pub(crate) fn folder(&self) -> &Path {
        self.folder.path()
    }

    pub(crate) fn report(&self) -> PathBuf {
        report_of(self.folder.path())
    }

    /// All that the supervisor has noted.
    pub(crate) fn events(&mut self) -> &[SupervisorEvent] {
        // A damaged log is found when the run is judged.
        self.seen.extend(self.log.news().unwrap_or_default());
        &self.seen
    }

    /// Id of the newest process of this name.
    pub(crate) fn pid_of(&mut self, process: &str) -> Option<u32> {
        let started = [SupervisorEventKind::Started, SupervisorEventKind::Restarted];
        let is_start = |event: &&SupervisorEvent| event.process == process && started.contains(&event.event);
        self.events().iter().rfind(is_start).map(|event| event.pid)
    }

    /// Signals a process of the set, if it still is one.
    pub(crate) fn signal_process(&mut self, process: &str, signal: Signal) -> Result<(), Trouble> {
        let gone = || Trouble(format!("{process} did not run when the fault was due"));
        let pid = self.pid_of(process).filter(|pid| self.owns(*pid)).ok_or_else(gone)?;
        let pid = Pid::from_raw(pid as i32).ok_or_else(gone)?;
        kill_process(pid, signal).map_err(|_| gone())
    }

    /// Signals the supervisor.
    pub(crate) fn signal(&self, signal: Signal) -> Result<(), Trouble> {
        let refused = |_| Trouble("the supervisor did not run when the fault was due".into());
        kill_process(Pid::from_child(&self.child), signal).map_err(refused)
    }

    /// Kills the supervisor.
    pub(crate) fn orphan(&mut self) -> Result<(), Trouble> {
        self.signal(Signal::KILL)?;
        self.child.wait().map(drop).map_err(|error| Trouble::because("the supervisor did not die")(&error))
    }

    /// `coact adopt`: a successor for a supervisor that is dead.
    pub(crate) fn adopt(&mut self, setup: &Setup) -> Result<(), Trouble> {
        let begin = || -> std::io::Result<_> {
            let stderr = File::create(self.folder.path().join("stderr-of-successor"))?;
            let mut command = Command::new(&setup.coact);
            command.args(["adopt", self.run.id(), "--resume"]).stdin(Stdio::null()).stdout(Stdio::null());
            command.stderr(stderr).spawn()
        };
        self.child = begin().map_err(|error| Trouble::because("no successor was started")(&error))?;
        Ok(())
    }

    /// The kernel grants the supervisor at most so many file handles from now on; returns how many before.
    pub(crate) fn limit_handles(&self, most: u64) -> Result<u64, Trouble> {
        let pid = Pid::from_child(&self.child);
        let maximum = getrlimit(Resource::Nofile).maximum;
        let limited = prlimit(Some(pid), Resource::Nofile, Rlimit { current: Some(most), maximum });
        let before = limited.map_err(|error| Trouble::because("the supervisor's file handles")(&error))?;
        Ok(before.current.unwrap_or(u64::MAX))
    }

    /// Whether the process was started for this run: it was told the run's directory.
    fn owns(&self, pid: u32) -> bool {
        tells_of(&PathBuf::from(format!("/proc/{pid}/cmdline")), self.run.directory())
    }

    /// Whether the supervisor has ended.
    pub(crate) fn has_ended(&mut self) -> bool {
        !matches!(self.child.try_wait(), Ok(None))
    }

    /// Waits for the end of the set, which was requested or is due, calling `meanwhile` every few milliseconds.
    pub(crate) fn end(&mut self, mut meanwhile: impl FnMut()) -> Ending {
        let begin = Instant::now();
        while begin.elapsed() < ENDS_WITHIN && !self.has_ended() {
            meanwhile();
            std::thread::sleep(POLL);
        }
        let status = self.child.try_wait().ok().flatten();
        if status.is_none() {
            self.child.kill().ok();
            self.child.wait().ok();
        }
        let gone = Instant::now();
        while gone.elapsed() < GONE_WITHIN && !self.processes_left().is_empty() {
            meanwhile();
            std::thread::sleep(POLL);
        }
        Ending { status, left_behind: self.left_behind(status) }
    }

    fn processes_left(&self) -> Vec<String> {
        let entries = std::fs::read_dir("/proc").into_iter().flatten().filter_map(Result::ok);
        let pids = entries.filter_map(|entry| entry.file_name().to_str()?.parse::<u32>().ok());
        pids.filter(|pid| self.owns(*pid)).map(|pid| format!("process {pid}")).collect()
    }

    /// Processes, directories and shared memory. Where the supervisor could not clean up, the next launch does.
    fn left_behind(&self, status: Option<ExitStatus>) -> Vec<String> {
        let mut left = self.processes_left();
        if status.is_none_or(|status| status.code().is_none()) {
            Run::remove_dead();
        }
        let name = format!("coact_{}", self.run.id());
        for folder in [Path::new("/dev/shm"), &std::env::temp_dir()] {
            let entries = std::fs::read_dir(folder).into_iter().flatten().filter_map(Result::ok);
            let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
            left.extend(names.filter(|entry| *entry == name || entry.starts_with(&self.run.prefix())));
        }
        left
    }
}

impl Drop for RunningSet {
    fn drop(&mut self) {
        // Whatever failed: no set stays. The supervisor's children end with it, or when nobody adopts them.
        self.child.kill().ok();
        self.child.wait().ok();
    }
}

fn world(setup: &Setup) -> &'static str {
    match setup.world {
        coact_pipeline::WorldMode::Kinematic => "kinematic",
        coact_pipeline::WorldMode::Physics => "physics",
    }
}

fn report_of(folder: &Path) -> PathBuf {
    folder.join("report")
}

/// The run that reports there.
fn find(report: &Path) -> Option<Run> {
    let begin = Instant::now();
    while begin.elapsed() < MADE_WITHIN {
        if let Some(run) = Run::all().into_iter().find(|run| run.settings().report == report) {
            return Some(run);
        }
        std::thread::sleep(POLL);
    }
    None
}

/// Whether a command line has this argument.
fn tells_of(command_line: &Path, argument: &Path) -> bool {
    let text = std::fs::read(command_line).unwrap_or_default();
    text.split(|byte| *byte == 0).any(|found| found == argument.as_os_str().as_encoded_bytes())
}
