//! Studies are another program's, and are built when they are first used. Here a script stands in for cargo.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// What cargo would build: a program that prints its arguments and ends with status 3.
const STUDIES: &str = "#!/bin/sh\necho \"$@\"\nexit 3\n";

/// A file that another thread has open for writing just when this one forks cannot be executed: one test at a time,
/// and none of other files beside them.
static ALONE: Mutex<()> = Mutex::new(());

fn alone() -> MutexGuard<'static, ()> {
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// `coact` where cargo would have built it, with no studies beside it.
struct Installed {
    folder: tempfile::TempDir,
}

impl Installed {
    fn new() -> Self {
        let folder = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).unwrap();
        let installed = Self { folder };
        fs::create_dir_all(installed.path("target/release")).unwrap();
        fs::create_dir_all(installed.path("bin")).unwrap();
        fs::write(installed.path("target/CACHEDIR.TAG"), "").unwrap();
        fs::hard_link(env!("CARGO_BIN_EXE_coact"), installed.path("target/release/coact")).unwrap();
        installed
    }

    fn path(&self, inner: &str) -> PathBuf {
        self.folder.path().join(inner)
    }

    /// Puts a cargo in the path that does this, in the shell's words, after it has noted its arguments.
    fn cargo(&self, does: &str) {
        let noted = self.path("cargo-arguments");
        script(&self.path("bin/cargo"), &format!("#!/bin/sh\necho \"$@\" >> {}\n{does}\n", noted.display()));
    }

    /// ... that builds the studies.
    fn cargo_builds(&self) {
        let (template, studies) = (self.path("studies"), self.path("target/release/coact-studies"));
        script(&template, STUDIES);
        self.cargo(&format!("/bin/cp {} {}", template.display(), studies.display()));
    }

    /// How often cargo was called, and with what.
    fn cargo_calls(&self) -> Vec<String> {
        let noted = fs::read_to_string(self.path("cargo-arguments")).unwrap_or_default();
        noted.lines().map(str::to_owned).collect()
    }

    fn coact(&self, arguments: &[&str]) -> Output {
        let mut coact = Command::new(self.path("target/release/coact"));
        coact.args(arguments).env("PATH", self.path("bin")).output().unwrap()
    }
}

fn script(path: &Path, text: &str) {
    fs::write(path, text).unwrap();
    fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
}

fn said(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

#[test]
fn the_first_use_builds_them_and_later_ones_start_at_once() {
    let _alone = alone();
    let installed = Installed::new();
    installed.cargo_builds();
    let first = installed.coact(&["evaluate", "--trials", "5"]);
    assert_eq!(said(&first), "building the studies, once: about a minute\n");
    let second = installed.coact(&["help", "evaluate"]);
    assert_eq!(said(&second), "");
    for (output, arguments) in [(first, "evaluate --trials 5\n"), (second, "help evaluate\n")] {
        assert_eq!(output.status.code(), Some(3));
        assert_eq!(String::from_utf8(output.stdout).unwrap(), arguments);
    }
    let calls = installed.cargo_calls();
    assert_eq!(calls.len(), 1);
    let target = installed.path("target");
    assert!(calls[0].starts_with("build -p coact-studies --manifest-path "), "{calls:?}");
    assert!(calls[0].contains(&format!("--target-dir {} --profile release", target.display())), "{calls:?}");
}

#[test]
fn studies_that_are_older_than_coact_are_built_anew() {
    let _alone = alone();
    let installed = Installed::new();
    installed.cargo_builds();
    installed.coact(&["evaluate"]);
    let studies = fs::File::open(installed.path("target/release/coact-studies")).unwrap();
    studies.set_modified(std::time::SystemTime::UNIX_EPOCH).unwrap();
    let output = installed.coact(&["evaluate"]);
    assert_eq!(said(&output), "building the studies anew: they are older than coact\n");
    assert_eq!(output.status.code(), Some(3));
    assert_eq!(installed.cargo_calls().len(), 2);
}

#[test]
fn studies_that_cannot_be_built_are_one_error() {
    let _alone = alone();
    let without_cargo = Installed::new();
    let failing = Installed::new();
    failing.cargo("exit 101");
    let elsewhere = Installed::new();
    elsewhere.cargo_builds();
    fs::remove_file(elsewhere.path("target/CACHEDIR.TAG")).unwrap();
    for (installed, why) in [
        (without_cargo, "cargo cannot be started"),
        (failing, "the build failed"),
        (elsewhere, "expected a folder that cargo builds into"),
    ] {
        let output = installed.coact(&["evaluate"]);
        assert_eq!(output.status.code(), Some(2));
        let said = said(&output);
        assert!(said.contains(why), "{said}");
        assert!(said.contains("cargo build --release -p coact-studies"), "{said}");
        assert_eq!(said.lines().count(), 2, "one line says what is done, one why it failed: {said}");
    }
}
