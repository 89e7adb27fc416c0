//! Run directories: found again, apart from each other, and gone when removed.
#![allow(clippy::unwrap_used)]

use coact_pipeline::{MemoryReserve, Ready, Run, RunError, RunSettings, WorldMode};
use std::fs::Permissions;
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::path::PathBuf;
use std::time::Duration;

fn ready(process: &str) -> Ready {
    Ready {
        process: process.to_owned(),
        generation: 2,
        pid: 1,
        started: 7,
        sentinel: 8,
        scheduler: "SCHED_OTHER".to_owned(),
        priority: 0,
        core: None,
        memory_locked: false,
        why_not: vec!["SCHED_FIFO: refused".to_owned()],
        resumed: true,
    }
}

#[test]
fn run_is_found_again_with_its_settings_and_its_start() {
    let settings = RunSettings {
        task: "/nowhere/task.toml".into(),
        seed: 7,
        partner: "synthetic".to_owned(),
        world: WorldMode::Kinematic,
        ..RunSettings::default()
    };
    let run = Run::create(settings).unwrap();
    assert_eq!(run.start_ns().unwrap(), None);
    run.start(123).unwrap();
    let found = Run::load(run.directory()).unwrap();
    assert_eq!(found, run);
    assert_eq!(found.start_ns().unwrap(), Some(123));
    assert!(found.owner_lives() && Run::all().contains(&run));
    run.remove().unwrap();
    assert!(!run.directory().exists() && !Run::all().contains(&run));
}

#[test]
fn other_iceoryx2_clients_find_root_and_prefix_in_the_run_directory() {
    let run = Run::create(RunSettings::default()).unwrap();
    let text = std::fs::read_to_string(run.directory().join("config/iceoryx2.toml")).unwrap();
    let config: toml::Table = text.parse().unwrap();
    assert_eq!(config["global"]["prefix"].as_str(), Some(run.prefix().as_str()));
    assert_eq!(config["global"]["root-path"].as_str(), run.iceoryx2_root().to_str());
    run.remove().unwrap();
}

#[test]
fn removing_one_run_leaves_the_other_alone() {
    let (first, second) =
        (Run::create(RunSettings::default()).unwrap(), Run::create(RunSettings::default()).unwrap());
    assert!(!first.prefix().starts_with(&second.prefix()) && !second.prefix().starts_with(&first.prefix()));
    let memory = |run: &Run| PathBuf::from(format!("/dev/shm/{}segment", run.prefix()));
    for run in [&first, &second] {
        std::fs::write(memory(run), "x").unwrap();
    }
    first.remove().unwrap();
    assert!(!memory(&first).exists() && memory(&second).exists() && second.directory().exists());
    second.remove().unwrap();
    assert!(!memory(&second).exists());
}

#[test]
fn readiness_is_known_for_the_generation_that_reported_it() {
    let run = Run::create(RunSettings::default()).unwrap();
    run.report_ready(&ready("fields")).unwrap();
    assert_eq!(run.ready("fields", 2).unwrap(), Some(ready("fields")));
    assert_eq!(run.ready("fields", 3).unwrap(), None);
    run.remove().unwrap();
}

/// A directory as a run has it, but not made by `Run::create`; removed when the test ends.
struct Planted(PathBuf);

impl Planted {
    fn new(name: &str, mode: u32) -> Self {
        let directory = PathBuf::from(format!("/dev/shm/coact_{name}-{}", std::process::id()));
        std::fs::create_dir(&directory).unwrap();
        std::fs::set_permissions(&directory, Permissions::from_mode(mode)).unwrap();
        Self(directory)
    }

    /// With the description of `run`, under the id `id`.
    fn describe(&self, run: &Run, id: &str, mode: u32) {
        let text = std::fs::read_to_string(run.directory().join("run.json")).unwrap().replace(run.id(), id);
        std::fs::write(self.0.join("run.json"), text).unwrap();
        std::fs::set_permissions(self.0.join("run.json"), Permissions::from_mode(mode)).unwrap();
    }
}

impl Drop for Planted {
    fn drop(&mut self) {
        std::fs::remove_dir_all(&self.0).ok();
    }
}

#[test]
fn a_run_lives_as_long_as_its_lock_is_held_and_is_removed_exactly_when_it_is_not() {
    let run = Run::create(RunSettings::default()).unwrap();
    let (found, directory) = (Run::load(run.directory()).unwrap(), run.directory().to_owned());
    let memory = PathBuf::from(format!("/dev/shm/{}segment", run.prefix()));
    std::fs::write(&memory, "x").unwrap();
    assert!(found.owner_lives());
    assert!(matches!(found.remove(), Err(RunError::Owned { .. })));
    assert!(Run::remove_dead().is_empty());
    assert!(directory.exists() && memory.exists());
    // The owner ends: whatever has become of its description, and whoever has its process id now.
    std::fs::write(directory.join("run.json"), "{").unwrap();
    drop(run);
    assert!(soon(|| !found.owner_lives()));
    // Another test that looks at the lock holds it for a moment, and whoever looks for remains then leaves them to the next one.
    let are_removed = || {
        Run::remove_dead();
        !directory.exists() && !memory.exists()
    };
    assert!(soon(are_removed), "by this test, or by another that looks for remains");
}

#[test]
fn a_description_that_names_another_run_is_refused_and_that_run_is_not_touched() {
    let victim = Run::create(RunSettings::default()).unwrap();
    let planted = Planted::new("planted", 0o700);
    planted.describe(&victim, victim.id(), 0o600);
    let error = Run::load(&planted.0).unwrap_err();
    assert!(matches!(error, RunError::Malformed { .. }), "{error}");
    Run::remove_dead();
    assert!(planted.0.exists(), "without a lock nothing says that it has ended");
    assert!(Run::load(victim.directory()).unwrap().owner_lives());
    victim.remove().unwrap();
}

#[test]
fn what_others_can_open_or_own_is_not_trusted() {
    let run = Run::create(RunSettings::default()).unwrap();
    let id = format!("open-{}", std::process::id());
    let planted = Planted::new("open", 0o755);
    planted.describe(&run, &id, 0o600);
    let open = Run::load(&planted.0).unwrap_err().to_string();
    assert!(open.contains("is open to others (mode 755); expected a directory of this user"), "{open}");
    std::fs::set_permissions(&planted.0, Permissions::from_mode(0o700)).unwrap();
    assert!(Run::load(&planted.0).is_ok());
    std::fs::set_permissions(planted.0.join("run.json"), Permissions::from_mode(0o644)).unwrap();
    assert!(matches!(Run::load(&planted.0), Err(RunError::Untrusted { .. })));
    // Only root can give a file away; elsewhere the modes above are the test.
    if std::os::unix::fs::chown(planted.0.join("run.json"), Some(12345), None).is_ok() {
        let foreign = Run::load(&planted.0).unwrap_err().to_string();
        assert!(foreign.contains("belongs to user 12345"), "{foreign}");
    }
    run.remove().unwrap();
}

#[test]
fn a_directory_without_a_run_says_why_once() {
    let error = Run::load("/no/such/run".as_ref()).unwrap_err();
    let shown = format!("{:#}", anyhow::Error::from(error));
    assert_eq!(shown.matches("No such file").count(), 1, "{shown}");
    assert!(shown.starts_with("/no/such/run: cannot be read: "), "{shown}");
}

#[test]
fn malformed_run_file_is_named() {
    let run = Run::create(RunSettings::default()).unwrap();
    std::fs::write(run.directory().join("run.json"), "{}").unwrap();
    let error = Run::load(run.directory()).unwrap_err().to_string();
    assert!(error.contains("run.json: missing field `id`"), "{error}");
    run.remove().unwrap();
}

#[test]
fn all_memory_of_a_run_is_allocated_and_as_much_again_is_reserved_for_replacements() {
    const SIZE: u64 = 3 << 20;
    let run = Run::create(RunSettings::default()).unwrap();
    let memory = |name: &str| PathBuf::from(format!("/dev/shm/{}{name}", run.prefix()));
    let allocated = |name: &str| memory(name).metadata().unwrap().blocks() * 512;
    std::fs::File::create(memory("segment")).unwrap().set_len(SIZE).unwrap();
    assert_eq!(allocated("segment"), 0, "a page is looked for when it is touched first");
    let reserve = MemoryReserve::take(&run).unwrap();
    assert_eq!((allocated("segment"), allocated("reserve")), (SIZE, SIZE));
    reserve.release().unwrap();
    assert_eq!(allocated("reserve"), SIZE, "there is other room for a replacement");
    std::fs::File::create(memory("of-replacement")).unwrap().set_len(SIZE / 3).unwrap();
    reserve.renew(&run).unwrap();
    assert_eq!((allocated("of-replacement"), allocated("reserve")), (SIZE / 3, SIZE));
    run.remove().unwrap();
    assert!(!memory("reserve").exists());
}

/// Whether it holds, if not at once then soon: other tests look for remains meanwhile, and hold each lock that they look at for an
/// instant.
fn soon(mut holds: impl FnMut() -> bool) -> bool {
    let again = || {
        std::thread::sleep(Duration::from_millis(1));
        holds()
    };
    std::iter::repeat_with(again).take(200).any(|held| held)
}

/// A run whose owner has died: found again, and nobody holds its lock any more.
fn left_by_owner() -> Run {
    let run = Run::create(RunSettings::default()).unwrap();
    run.start(123).unwrap();
    let found = Run::load(run.directory()).unwrap();
    drop(run);
    found
}

#[test]
fn a_run_whose_owner_died_is_no_remains_while_it_has_a_member_and_is_owned_again_once_it_is_adopted() {
    let found = left_by_owner();
    let member = found.become_member().unwrap();
    assert!(soon(|| found.is_orphaned() && !found.owner_lives()));
    found.wait_for_death_of_owner().unwrap();
    Run::remove_dead();
    assert!(matches!(found.remove(), Err(RunError::Owned { .. })));
    assert!(found.directory().exists());
    assert_eq!(found.owner().unwrap().generation, 0);
    let adopted = found.adopt().unwrap();
    let owner = found.owner().unwrap();
    assert_eq!((owner.generation, owner.pid), (1, std::process::id()), "whoever looks finds the new owner");
    assert!(found.owner_lives() && !found.is_orphaned());
    let refused = found.adopt().unwrap_err().to_string();
    assert!(refused.contains("its supervisor lives; expected a run whose supervisor has died"), "{refused}");
    assert!(matches!(adopted.remove(), Err(RunError::Owned { .. })), "its member uses it");
    drop(member);
    adopted.remove().unwrap();
    assert!(!found.directory().exists());
}

#[test]
fn a_run_without_members_or_without_a_beginning_is_not_adopted() {
    let found = left_by_owner();
    let refused = found.adopt().unwrap_err().to_string();
    assert!(refused.contains("none of its processes lives any more"), "{refused}");
    std::fs::remove_file(found.directory().join("start")).unwrap();
    let member = found.become_member().unwrap();
    let refused = found.adopt().unwrap_err().to_string();
    assert!(refused.contains("had not begun"), "{refused}");
    assert!(soon(|| found.is_orphaned()), "a refusal leaves the run as it was");
    drop(member);
    assert!(soon(|| found.remove().is_ok()));
}

#[test]
fn the_newest_report_of_a_process_is_that_of_its_highest_generation() {
    let run = Run::create(RunSettings::default()).unwrap();
    assert_eq!(run.newest_ready("fields").unwrap(), None);
    for (process, generation) in [("fields", 2), ("fields", 10), ("fields", 9), ("fields-standby", 11)] {
        run.report_ready(&Ready { generation, ..ready(process) }).unwrap();
    }
    assert_eq!(run.newest_ready("fields").unwrap().unwrap().generation, 10);
    run.remove().unwrap();
}
