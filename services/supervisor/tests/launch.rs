//! Whole runs, with shell scripts in place of services: what a run makes, and that nothing of it stays.
#![allow(clippy::unwrap_used)]

use coact_joint_task::Task;
use coact_pipeline::{Pipeline, Run, RunSettings};
use coact_run_records::{RunLog, Summary, SupervisorEvent, SupervisorEventKind, Verdict};
use coact_supervisor::{Ending, Launch, LaunchError, request_fault};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Reports ready as a service does, then runs until it gets SIGTERM.
const SERVICE: &str = r#"#!/bin/sh
name=${0##*/}
cat > "$2/ready/$name.$COACT_GENERATION.json" <<END
{"process": "$name", "generation": $COACT_GENERATION, "pid": $$, "scheduler": "SCHED_OTHER", "priority": 0,
 "core": null, "memory_locked": false, "why_not": [], "resumed": false}
END
exec sleep 600
"#;

struct Place(tempfile::TempDir);

impl Place {
    fn new(scripts: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        for (name, script) in scripts {
            let path = folder.path().join(name);
            std::fs::write(&path, script).unwrap();
            std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
        }
        Self(folder)
    }

    fn launch(&self, names: &[&str], duration: Duration, injections: &[&str]) -> Launch {
        let configuration = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
        let entry =
            |name: &&str| format!("[[process]]\nname = \"{name}\"\nprogram = \"{name}\"\norder = 1\n");
        let table: String = names.iter().map(entry).collect();
        let task = configuration.join("tasks/toy-vehicle.toml");
        let settings = RunSettings {
            task: task.clone(),
            report: self.0.path().join("report"),
            duration: Some(duration),
            ..RunSettings::default()
        };
        Launch {
            settings,
            pipeline: Pipeline::parse(&table, "table.toml".as_ref()).unwrap(),
            task: Task::load(&task).unwrap(),
            programs: self.0.path().to_owned(),
            injections: injections.iter().map(|spec| spec.parse().unwrap()).collect(),
        }
    }

    fn events(&self) -> Vec<SupervisorEvent> {
        // While the run is being made, there is none.
        RunLog::read(&self.0.path().join("report")).unwrap_or_default()
    }

    /// The run that reports here, once it has been made.
    fn run(&self) -> Run {
        let report = self.0.path().join("report");
        wait_for(|| Run::all().into_iter().find(|run| run.settings().report == report))
    }

    fn count(&self, kind: SupervisorEventKind, process: &str) -> usize {
        self.events().iter().filter(|event| event.event == kind && event.process == process).count()
    }
}

fn wait_for<T>(mut poll: impl FnMut() -> Option<T>) -> T {
    let begin = Instant::now();
    loop {
        if let Some(found) = poll() {
            return found;
        }
        assert!(begin.elapsed() < Duration::from_secs(60), "timed out");
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn in_background(launch: Launch) -> JoinHandle<Result<Ending, LaunchError>> {
    std::thread::spawn(|| launch.run())
}

fn shared_memory_of(run: &Run) -> usize {
    let files = std::fs::read_dir("/dev/shm").unwrap();
    files
        .filter(|file| file.as_ref().unwrap().file_name().to_string_lossy().starts_with(&run.prefix()))
        .count()
}

const LONG: Duration = Duration::from_secs(3);

#[test]
fn a_run_lasts_its_duration_and_leaves_nothing_but_its_report() {
    let place = Place::new(&[("a", SERVICE), ("b", SERVICE)]);
    let running = in_background(place.launch(&["a", "b"], LONG, &[]));
    let run = place.run();
    wait_for(|| run.start_ns().unwrap());
    assert!(shared_memory_of(&run) > 0);
    assert_eq!(running.join().unwrap().unwrap(), Ending::DurationOver);
    assert!(!run.directory().exists());
    assert_eq!(shared_memory_of(&run), 0);
    for (kind, process) in [
        (SupervisorEventKind::Ready, "a"),
        (SupervisorEventKind::Stopped, "a"),
        (SupervisorEventKind::Stopped, "b"),
    ] {
        assert_eq!(place.count(kind, process), 1, "{kind:?} {process}");
    }
}

#[test]
fn faults_are_injected_at_their_time_and_on_request() {
    let place = Place::new(&[("a", SERVICE), ("b", SERVICE)]);
    let running = in_background(place.launch(&["a", "b"], LONG, &["a:kill@100ms"]));
    let run = place.run();
    wait_for(|| (place.count(SupervisorEventKind::Ready, "a") == 2).then_some(()));
    request_fault(&run, "b", "crash-on-start").unwrap();
    let unknown = request_fault(&run, "c", "kill").unwrap_err().to_string();
    assert!(unknown.contains("this set has: a, b"), "{unknown}");
    let unknown = request_fault(&run, "b", "melt").unwrap_err().to_string();
    assert!(
        unknown.contains("expected one of: kill, stop, ") && unknown.contains(", crash-on-start"),
        "{unknown}"
    );
    running.join().unwrap().unwrap();
    assert_eq!(
        (place.count(SupervisorEventKind::Injected, "a"), place.count(SupervisorEventKind::Restarted, "a")),
        (1, 1)
    );
    assert_eq!(
        (place.count(SupervisorEventKind::Injected, "b"), place.count(SupervisorEventKind::Restarted, "b")),
        (1, 2)
    );
}

#[test]
fn two_runs_beside_each_other_do_not_touch_each_other() {
    let (short, long) = (Place::new(&[("a", SERVICE)]), Place::new(&[("a", SERVICE)]));
    let longer = in_background(long.launch(&["a"], LONG, &[]));
    let run = long.run();
    short.launch(&["a"], Duration::from_millis(200), &["a:kill@0s"]).run().unwrap();
    assert!(run.directory().exists() && shared_memory_of(&run) > 0);
    longer.join().unwrap().unwrap();
    assert_eq!(short.count(SupervisorEventKind::Died, "a"), 1);
    assert_eq!(long.count(SupervisorEventKind::Died, "a"), 0);
}

#[test]
fn what_is_missing_or_unknown_is_named_before_anything_is_started() {
    let place = Place::new(&[("a", SERVICE)]);
    let missing = place.launch(&["a", "b"], LONG, &[]).run().unwrap_err();
    assert!(missing.is_configuration());
    assert!(
        missing.to_string().contains("process b") && missing.to_string().contains("cargo build"),
        "{missing}"
    );
    let unknown = place.launch(&["a"], LONG, &["z:kill@1s"]).run().unwrap_err();
    assert!(unknown.is_configuration() && unknown.to_string().contains("\"z\""), "{unknown}");
    assert!(place.events().is_empty());
}

#[test]
fn a_set_that_is_given_up_is_stopped_and_leaves_nothing() {
    let place = Place::new(&[("a", SERVICE), ("b", "#!/bin/sh\necho 'no arm found' >&2\nexit 1\n")]);
    let running = in_background(place.launch(&["a", "b"], LONG, &[]));
    let run = place.run();
    let error = running.join().unwrap().unwrap_err();
    assert!(error.is_configuration());
    assert!(error.to_string().contains("no arm found"), "{error}");
    assert_eq!(place.count(SupervisorEventKind::Stopped, "a"), 1);
    assert!(!run.directory().exists());
    assert_eq!(shared_memory_of(&run), 0);
}

#[test]
fn an_earlier_summary_in_the_report_folder_is_not_taken_for_this_runs() {
    let place = Place::new(&[("a", SERVICE)]);
    let launch = place.launch(&["a"], Duration::from_millis(10), &[]);
    let summary = launch.settings.report.join(Summary::FILE);
    std::fs::create_dir_all(&launch.settings.report).unwrap();
    std::fs::write(&summary, "{}").unwrap();
    launch.run().unwrap();
    assert!(!summary.exists());
}

#[test]
fn a_run_whose_monitor_never_lived_goes_on_and_has_a_summary_that_says_so() {
    let place = Place::new(&[("a", SERVICE), ("monitor", "#!/bin/sh\nkill -9 $$\n")]);
    let mut launch = place.launch(&["a", "monitor"], Duration::from_millis(500), &[]);
    launch
        .pipeline
        .processes
        .iter_mut()
        .filter(|entry| entry.name == "monitor")
        .for_each(|entry| entry.needed = false);
    let report = launch.settings.report.clone();
    assert_eq!(launch.run().unwrap(), Ending::DurationOver);
    let summary = Summary::read(&report).unwrap();
    assert_eq!(summary.work.verdict, Verdict::Fail);
    assert!(
        summary.work.reasons[0].starts_with("the monitor wrote no summary"),
        "{:?}",
        summary.work.reasons
    );
    assert!(place.count(SupervisorEventKind::Restarted, "monitor") > 3);
    assert_eq!(place.count(SupervisorEventKind::Died, "a"), 0);
}

/// As the command line prints it: with its chain of causes.
fn printed(error: impl std::error::Error + Send + Sync + 'static) -> String {
    format!("{:#}", anyhow::Error::from(error))
}

#[test]
fn the_cause_of_an_error_is_printed_once() {
    let place = Place::new(&[("a", SERVICE)]);
    let mut launch = place.launch(&["a"], LONG, &[]);
    launch.settings.report = place.0.path().join("a/report");
    let refused = printed(launch.run().unwrap_err());
    assert_eq!(refused.matches("Not a directory").count(), 1, "{refused}");
    let run = Run::create(RunSettings::default()).unwrap();
    let unreachable = printed(request_fault(&run, "a", "kill").unwrap_err());
    run.remove().unwrap();
    assert_eq!(unreachable.matches("No such file").count(), 1, "{unreachable}");
}
