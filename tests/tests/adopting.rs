//! The supervisor may die: the arm stands, the processes live on, and a successor goes on with them, or nobody does.
#![allow(clippy::unwrap_used)]

use coact_messages::SensorSample;
use coact_pipeline::Run;
use coact_run_records::{SupervisorEvent, SupervisorEventKind};
use coact_table_edit::TableEdit;
use coact_tests::{JointViewer, Launched, alone, checkout, left_behind, operate, wait_for, wait_within};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::OFlags;
use rustix::process::{Pid, PidfdFlags, Signal, kill_process, pidfd_open};
use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::os::unix::fs::OpenOptionsExt;
use std::path::{Path, PathBuf};
use std::time::Duration;
use tempfile::TempDir;

const PROCESSES: [&str; 6] = ["world", "perception", "fields", "control", "monitor", "voice"];
/// Orphaned processes live on for so long where somebody comes. A test that fails leaves them behind for no longer, s.
const PATIENT: f64 = 40.0;
/// ... and where nobody does.
const SHORT: f64 = 3.0;
/// Within so long after their time orphaned processes have ended, on a busy machine too: longer than every grace.
const ENDS_WITHIN: Duration = Duration::from_secs(20);

/// The process table of a set that can be adopted, in a folder of its own.
fn table(folder: &Path, adoptable_for_s: f64) -> PathBuf {
    let table = TableEdit::of(&checkout().join("rt-config")).unwrap();
    table.with("supervision", "adoptable_for_s", adoptable_for_s).unwrap().write(folder).unwrap()
}

fn start(table: &Path, duration: &str) -> Launched {
    let table = table.to_str().unwrap();
    Launched::start(&["--duration", duration, "--world", "kinematic", "--pipeline", table])
}

/// Process ids of a run's newest generations, in the order of [`PROCESSES`].
fn pids(run: &Run) -> [u32; 6] {
    PROCESSES.map(|process| run.newest_ready(process).unwrap().unwrap().pid)
}

/// No thread of it does when it is dead, whether somebody has reaped it or not.
fn lives(pid: u32) -> bool {
    let Ok(pidfd) = pidfd_open(Pid::from_raw(pid.cast_signed()).unwrap(), PidfdFlags::empty()) else {
        return false;
    };
    poll(&mut [PollFd::new(&pidfd, PollFlags::IN)], Some(&Timespec { tv_sec: 0, tv_nsec: 0 })).unwrap() == 0
}

/// Writes a line to a process's standard error, as that would itself.
fn write_as(pid: u32, line: &str) {
    let no_wait = OFlags::NONBLOCK.bits().cast_signed();
    let mut open = OpenOptions::new();
    let mut stderr = open.write(true).custom_flags(no_wait).open(format!("/proc/{pid}/fd/2")).unwrap();
    let line = format!("{line}\n");
    wait_for("room for a line", || {
        let written = stderr.write_all(line.as_bytes());
        let is_full = written.as_ref().is_err_and(|error| error.kind() == ErrorKind::WouldBlock);
        (!is_full).then(|| written.unwrap())
    });
}

/// A set whose supervisor was killed while the arm moved, and whose arm stands.
struct Orphaned {
    /// Of its process table, as long as the set lives.
    _folder: TempDir,
    launched: Launched,
    run: Run,
    viewer: JointViewer,
    /// Process ids, in the order of [`PROCESSES`].
    before: [u32; 6],
    /// Where the arm stands.
    stood: SensorSample,
}

impl Orphaned {
    /// One that can be adopted for so long.
    fn of(adoptable_for_s: f64, duration: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut launched = start(&table(folder.path(), adoptable_for_s), duration);
        let run = launched.when_started();
        let mut viewer = JointViewer::join(&run);
        let before = pids(&run);
        viewer.until_fast();
        launched.kill();
        let stood = viewer.until_it_stands();
        Self { _folder: folder, launched, run, viewer, before, stood }
    }
}

fn kill(pid: u32) {
    kill_process(Pid::from_raw(pid.cast_signed()).unwrap(), Signal::KILL).unwrap();
    wait_for("the death of a killed process", || (!lives(pid)).then_some(()));
}

fn when_adopted(run: &Run, generation: u32) {
    wait_within(Duration::from_secs(30), "a successor", || {
        run.owner().is_ok_and(|owner| owner.generation == generation).then_some(())
    });
}

fn deaths(supervisor: &[SupervisorEvent]) -> Vec<&SupervisorEvent> {
    supervisor.iter().filter(|event| event.event == SupervisorEventKind::Died).collect()
}

#[test]
fn a_successor_goes_on_with_the_same_processes_and_the_arm_stands_until_an_operator_resumes() {
    let _alone = alone();
    let Orphaned { _folder, mut launched, run, mut viewer, before, stood, .. } = Orphaned::of(PATIENT, "100");
    assert!(run.is_orphaned() && before.iter().all(|&pid| lives(pid)));
    let (code, said, _) = operate(&["stop", "--run", run.id()]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains(&format!("coact adopt {}", run.id())), "{said}");
    let beside = Launched::start(&["--duration", "0.1", "--world", "kinematic"]).finish();
    assert!(beside.stderr.contains(&format!("coact adopt {}", run.id())), "{}", beside.stderr);
    assert!(run.is_orphaned() && before.iter().all(|&pid| lives(pid)), "a launch beside it removed it");

    launched.adopt(&[run.id()]);
    when_adopted(&run, 1);
    viewer.sees_it_stay(&stood);
    let (code, said, _) = operate(&["adopt", run.id()]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("its supervisor lives"), "{said}");
    let (code, said, _) = operate(&["resume", "--run", run.id()]);
    assert_eq!(code, Some(0), "{said}");
    viewer.until_fast();
    assert_eq!(pids(&run), before);
    // Supervised again: what dies is replaced, and goes on from its checkpoint.
    kill(before[2]);
    let replacement = wait_for("a replacement", || run.ready("fields", 1).unwrap());
    assert!(replacement.resumed);
    // Whatever it had achieved before, it builds on.
    wait_for("a subgoal that is achieved", || launched.said().contains("achieved: ").then_some(()));
    launched.signal(Signal::TERM);

    let finished = launched.finish();
    assert_eq!(left_behind(&run), Vec::<String>::new());
    let code = i32::from(!finished.summary().work.passes());
    assert_eq!(finished.code, Some(code), "{}", finished.stderr);
    assert!(finished.summary().task.achieved >= 1, "{}", finished.stderr);
    assert!(!finished.summary().environment.kernel.is_empty(), "the monitor wrote the summary");
    let of_operator = |kind| finished.count(kind, SupervisorEvent::OPERATOR);
    assert_eq!(of_operator(SupervisorEventKind::Adopted), 1);
    assert_eq!(of_operator(SupervisorEventKind::OperatorStopped), 1);
    assert_eq!(of_operator(SupervisorEventKind::OperatorResumed), 1);
    let dead: Vec<_> = deaths(&finished.supervisor).iter().map(|death| death.process.as_str()).collect();
    assert_eq!(dead, ["fields"]);
    assert_eq!(finished.count(SupervisorEventKind::Stopped, "world"), 1);
    let shown = ["adopted by user", "decides: ", "fields is back (restart 1)"];
    assert!(shown.iter().all(|shown| finished.stderr.contains(shown)), "{}", finished.stderr);
}

#[test]
fn what_died_while_nobody_supervised_is_replaced_and_a_successor_can_have_a_successor() {
    let _alone = alone();
    let Orphaned { _folder, mut launched, run, mut viewer, before, .. } = Orphaned::of(PATIENT, "100");
    // More than a pipe holds: nobody waits for a reader, nor dies for want of one.
    (0..200).for_each(|_| write_as(before[0], &"long ago ".repeat(100)));
    write_as(before[0], "just now");
    for index in [3, 5] {
        kill(before[index]);
    }
    launched.adopt(&[run.id(), "--resume"]);
    for process in ["control", "voice"] {
        wait_for(process, || run.ready(process, 1).unwrap());
    }
    viewer.until_fast();
    assert!(launched.said().contains("world: just now"), "{}", launched.said());
    launched.kill();
    let stood = viewer.until_it_stands();
    launched.adopt(&[]);
    when_adopted(&run, 2);
    viewer.sees_it_stay(&stood);
    let after = pids(&run);
    for (index, process) in PROCESSES.iter().enumerate() {
        assert_eq!(after[index] == before[index], ![3, 5].contains(&index), "{process}");
        assert!(lives(after[index]), "{process}");
    }
    write_as(before[0], "to the second");
    launched.signal(Signal::TERM);
    let finished = launched.finish();
    assert_eq!(left_behind(&run), Vec::<String>::new());
    assert!(finished.stderr.contains("world: to the second"), "{}", finished.stderr);
    assert_eq!(finished.count(SupervisorEventKind::Adopted, SupervisorEvent::OPERATOR), 2);
    assert_eq!(finished.count(SupervisorEventKind::StateDropped, "control"), 1);
    let deaths = deaths(&finished.supervisor);
    assert!(deaths.iter().all(|death| death.reason.as_ref().unwrap().contains("found dead")), "{deaths:?}");
    assert_eq!(deaths.len(), 2);
}

#[test]
fn when_nobody_comes_all_processes_end_and_the_next_launch_removes_what_is_left() {
    let _alone = alone();
    let Orphaned { _folder, launched: _launched, run, viewer: _viewer, before, .. } =
        Orphaned::of(SHORT, "60");
    assert!(before.iter().all(|&pid| lives(pid)));
    let most = Duration::from_secs_f64(SHORT) + ENDS_WITHIN;
    wait_within(most, "the end of all processes", || before.iter().all(|&pid| !lives(pid)).then_some(()));
    assert!(!run.is_orphaned());
    let (code, said, _) = operate(&["adopt", run.id()]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("none of its processes lives"), "{said}");
    assert!(!left_behind(&run).is_empty());
    Launched::start(&["--duration", "0.1", "--world", "kinematic"]).finish();
    assert_eq!(left_behind(&run), Vec::<String>::new());
    let (code, said, _) = operate(&["adopt", run.id()]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains(&format!("there is no run {}", run.id())), "{said}");
}

#[test]
fn a_set_that_has_not_begun_ends_with_its_supervisor_whatever_the_table_says() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let mut launched = start(&table(folder.path(), PATIENT), "60");
    let run = launched.run();
    let monitor = wait_for("the first process", || run.ready("monitor", 0).unwrap()).pid;
    launched.kill();
    assert_eq!(run.start_ns().unwrap(), None, "this test came too late");
    wait_within(ENDS_WITHIN, "its end", || (!lives(monitor) && !run.is_orphaned()).then_some(()));
    Launched::start(&["--duration", "0.1", "--world", "kinematic"]).finish();
    assert_eq!(left_behind(&run), Vec::<String>::new());
}
