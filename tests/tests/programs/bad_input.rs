//! Bad input is refused before anything is started, with file and line, and with the cause once.
#![allow(clippy::unwrap_used)]

use coact_tests::{Finished, Launched, checkout, coact};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A copy of the configuration, to make mistakes in.
fn configuration() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    copy(&checkout().join("rt-config"), &folder.path().join("rt-config"));
    folder
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap().map(Result::unwrap) {
        let target = to.join(entry.file_name());
        match entry.path().is_dir() {
            true => copy(&entry.path(), &target),
            false => assert!(std::fs::copy(entry.path(), target).is_ok()),
        }
    }
}

/// Replaces the first `from` in a file by `to`; returns file and line as an error should name them.
fn make_mistake(file: PathBuf, from: &str, to: &str) -> String {
    let text = std::fs::read_to_string(&file).unwrap();
    let at = text.find(from).unwrap();
    std::fs::write(&file, text.replacen(from, to, 1)).unwrap();
    format!("{}:{}", file.file_name().unwrap().to_string_lossy(), 1 + text[..at].matches('\n').count())
}

fn refused(arguments: &[&str]) -> Finished {
    let finished = Launched::start(arguments).finish();
    assert_eq!(finished.code, Some(2), "{}", finished.stderr);
    assert!(finished.supervisor.is_empty(), "nothing was started");
    finished
}

#[test]
fn a_malformed_task_is_refused_with_file_and_line() {
    let folder = configuration();
    let task = folder.path().join("rt-config/tasks/toy-vehicle.toml");
    let place = make_mistake(
        task.clone(),
        "after = [\"wheel on the robot's side\"]",
        "after = [\"wheel on the moon\"]",
    );
    let finished = refused(&["--task", task.to_str().unwrap()]);
    assert!(
        finished.stderr.contains(&place) && finished.stderr.contains("moon"),
        "{place}: {}",
        finished.stderr
    );
}

#[test]
fn what_is_no_regular_file_is_refused_wherever_a_file_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    for option in ["--task", "--pipeline", "--safety"] {
        for (file, what) in [("/dev/zero", "is a device"), (pipe.to_str().unwrap(), "is a pipe")] {
            let finished = refused(&[option, file]);
            let expected = format!("{what}; expected a regular file");
            assert!(finished.stderr.contains(&expected), "{option} {file}: {}", finished.stderr);
        }
    }
    let script = format!("script:{}", pipe.display());
    assert!(refused(&["--partner", &script]).stderr.contains("is a pipe"));
}

#[test]
fn a_number_that_is_no_length_is_refused_with_its_range() {
    for number in ["nan", "1e300", "-1e300"] {
        let folder = configuration();
        let task = folder.path().join("rt-config/tasks/toy-vehicle.toml");
        let place = make_mistake(task.clone(), "radius = 0.0375", &format!("radius = {number}"));
        let finished = refused(&["--task", task.to_str().unwrap()]);
        assert!(finished.stderr.contains(&place), "{number}: {place}: {}", finished.stderr);
        assert!(finished.stderr.contains("expected 0.0001 to 1 (m)"), "{number}: {}", finished.stderr);
    }
}

/// Makes a mistake in the process table; returns its place, and what was printed.
fn refused_pipeline(from: &str, to: &str) -> (String, String) {
    let folder = configuration();
    let pipeline = folder.path().join("rt-config/pipeline.toml");
    let place = make_mistake(pipeline.clone(), from, to);
    (place, refused(&["--pipeline", pipeline.to_str().unwrap()]).stderr)
}

#[test]
fn a_malformed_pipeline_is_refused_with_file_and_line() {
    let (place, printed) = refused_pipeline("priority = 83", "priority = 183");
    assert!(printed.contains(&place) && printed.contains("183"), "{place}: {printed}");
}

#[test]
fn a_pipeline_with_a_period_is_refused_with_the_reason() {
    let (place, printed) = refused_pipeline("[restart]", "period_us = 500\n[restart]");
    assert!(printed.contains(&format!("{place}: period_us: is not a setting")), "{printed}");
    assert!(printed.contains("the period is 1 ms, a constant"), "{printed}");
}

#[test]
fn the_cause_of_an_error_is_printed_once() {
    let finished = refused(&["--pipeline", "/no/such/pipeline.toml"]);
    assert_eq!(finished.stderr.matches("No such file or directory").count(), 1, "{}", finished.stderr);
}

#[test]
fn a_program_that_is_not_there_is_named() {
    let (_, printed) = refused_pipeline("program = \"coact-voice\"", "program = \"coact-choir\"");
    assert!(printed.contains("coact-choir does not exist"), "{printed}");
}

#[test]
fn an_unknown_process_or_fault_is_refused_with_those_that_there_are() {
    let finished = refused(&["--inject", "wheels:kill@1s"]);
    assert!(
        finished.stderr.contains("wheels") && finished.stderr.contains("perception"),
        "{}",
        finished.stderr
    );
    let finished = refused(&["--inject", "fields:melt@1s"]);
    assert!(finished.stderr.contains("crash-on-start"), "{}", finished.stderr);
}

#[test]
fn a_partner_that_makes_no_sense_is_refused() {
    let finished = refused(&["--partner", "robot"]);
    assert!(finished.stderr.contains("script:FILE"), "{}", finished.stderr);
    let script = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(&script, "[[act]]\nchain = 7\n").unwrap();
    let partner = format!("script:{}", script.path().display());
    let finished = refused(&["--partner", &partner]);
    let name = script.path().file_name().unwrap().to_string_lossy();
    assert!(finished.stderr.contains(&format!("{name}:")), "{}", finished.stderr);
    refused(&["--partner", "recorded:/no/such/folder"]);
}

#[test]
fn a_full_shared_memory_is_said_so() {
    let mut command = Command::new("unshare");
    let small = "mount -t tmpfs -o size=4m tmpfs /dev/shm && exec \"$0\" \"$@\"";
    // Whoever is not root becomes it in a namespace of his own.
    let root = rustix::process::getuid().is_root();
    command.args(if root { &["--mount"][..] } else { &["--mount", "--map-root-user"] });
    command.args(["sh", "-c", small]).arg(coact());
    let finished = Launched::start_by(command, &["--duration", "1"]).finish();
    assert_eq!(finished.code, Some(2), "{}", finished.stderr);
    assert!(finished.stderr.contains("/dev/shm") && finished.stderr.contains("MiB"), "{}", finished.stderr);
}

#[test]
fn without_real_time_privileges_it_runs_and_says_so() {
    let mut command = Command::new("prlimit");
    command.args(["--rtprio=0", "--memlock=65536"]);
    if rustix::process::getuid().is_root() {
        command.args(["setpriv", "--bounding-set=-sys_nice,-ipc_lock", "--inh-caps=-sys_nice,-ipc_lock"]);
    }
    command.arg(coact());
    let finished = Launched::start_by(command, &["--duration", "3", "--world", "kinematic"]).finish();
    assert!(matches!(finished.code, Some(0 | 1)), "{}", finished.stderr);
    assert!(finished.stderr.contains("SCHED_FIFO"), "{}", finished.stderr);
    let environment = &finished.summary().environment;
    assert!(!environment.memory_locked);
    assert!(finished.cycles("fields") > 1500, "{}", finished.stderr);
    for process in ["world", "perception", "fields", "control"] {
        assert!(environment.schedulers.contains_key(process));
    }
}

#[test]
fn too_few_open_files_are_said_so_before_anything_starts() {
    let mut command = Command::new("prlimit");
    command.arg("--nofile=64").arg(coact());
    let finished = Launched::start_by(command, &["--duration", "1"]).finish();
    assert_eq!(finished.code, Some(2), "{}", finished.stderr);
    for said in ["64 open files", "512", "ulimit -Hn"] {
        assert!(finished.stderr.contains(said), "{said}: {}", finished.stderr);
    }
    assert!(finished.supervisor.is_empty(), "nothing was started");
}
