//! The set as a service of systemd: the units are right, and systemd is told what it waits for.
#![allow(clippy::unwrap_used)]

use coact_joint_task::Task;
use coact_pipeline::{Pipeline, RunSettings};
use coact_supervisor::Launch;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::net::UnixDatagram;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

const FOLDER: &str = "COACT_TEST_FOLDER";

fn configuration() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config")
}

#[test]
fn systemd_finds_nothing_wrong_with_the_units() {
    if Command::new("systemd-analyze").arg("--version").output().is_err() {
        eprintln!("systemd-analyze is not here: the units are not checked");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let mut units = Vec::new();
    for name in ["coact.service", "coact.slice"] {
        let text = std::fs::read_to_string(configuration().join("system/systemd").join(name)).unwrap();
        // The installation that the unit names is not on this machine.
        assert!(name.ends_with("slice") || text.contains("ExecStart=/opt/coact/"));
        let text = text.replace("/opt/coact/target/release/coact", "/bin/true");
        units.push(folder.path().join(name));
        std::fs::write(units.last().unwrap(), text).unwrap();
    }
    let checked = Command::new("systemd-analyze").args(["verify", "--man=no"]).args(&units).output().unwrap();
    let said = String::from_utf8_lossy(&checked.stderr);
    // Of other units of this machine it may complain, too.
    let of_ours: Vec<_> = said.lines().filter(|line| line.contains("coact")).collect();
    assert!(of_ours.is_empty(), "{of_ours:#?}");
}

const SERVICE: &str = "#!/bin/sh\ntouch \"$2/ready/a.$COACT_GENERATION.json\"\nexec sleep 600\n";

/// Not a test of its own: the process that systemd would start.
#[test]
#[ignore = "the service, started by the test below"]
fn service() {
    let Some(folder) = std::env::var_os(FOLDER).map(PathBuf::from) else { return };
    let task = configuration().join("tasks/toy-vehicle.toml");
    let table = "[[process]]\nname = \"a\"\nprogram = \"a\"\norder = 1\n";
    let launch = Launch {
        settings: RunSettings {
            task: task.clone(),
            report: folder.join("report"),
            duration: Some(Duration::from_millis(600)),
            ..RunSettings::default()
        },
        pipeline: Pipeline::parse(table, "table.toml".as_ref()).unwrap(),
        task: Task::load(&task).unwrap(),
        programs: folder,
        injections: Vec::new(),
    };
    launch.run().unwrap();
}

#[test]
fn systemd_is_told_that_the_run_begins_that_the_supervisor_lives_and_that_it_ends() {
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("a");
    std::fs::write(&program, SERVICE).unwrap();
    std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755)).unwrap();
    let socket = folder.path().join("notify");
    let systemd = UnixDatagram::bind(&socket).unwrap();
    systemd.set_nonblocking(true).unwrap();
    let mut service = Command::new(std::env::current_exe().unwrap())
        .args(["service", "--exact", "--ignored"])
        .env("NOTIFY_SOCKET", &socket)
        .env("WATCHDOG_USEC", "200000")
        .env(FOLDER, folder.path())
        .spawn()
        .unwrap();
    let mut told = Vec::new();
    let status = loop {
        // Looked at first: what was told before the end is there after it.
        let ended = service.try_wait().unwrap();
        let mut message = [0; 256];
        while let Ok(length) = systemd.recv(&mut message) {
            told.push(String::from_utf8_lossy(&message[..length]).trim().to_owned());
        }
        if let Some(status) = ended {
            break status;
        }
        std::thread::sleep(Duration::from_millis(5));
    };
    service.wait().unwrap();
    assert!(status.success());
    let at = |state: &str| {
        told.iter().position(|told| told == state).unwrap_or_else(|| panic!("{state}: {told:?}"))
    };
    assert!(at("READY=1") < at("STOPPING=1"), "{told:?}");
    // Every 100 ms for 600 ms and the start; fewer where the machine is late, but never fewer than half.
    assert!(told.iter().filter(|told| *told == "WATCHDOG=1").count() >= 3, "{told:?}");
}
