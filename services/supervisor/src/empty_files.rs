use coact_realtime::SchedulingClass;
use std::collections::BTreeSet;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::{Builder, JoinHandle};
use std::time::Duration;

/// Removes shared memory that its maker has named, and does not live to give a size.
///
/// iceoryx2 (0.10) waits without end for such a file, whoever opens it: one process that is killed between these two system calls,
/// some microseconds apart, would stop the supervisor and every process that it is to be connected to. They go on as soon as the file
/// is gone. On a thread of its own, for nobody is safe from that wait who opens anything.
#[derive(Debug)]
pub(crate) struct EmptyFiles {
    /// Dropped, it ends the thread.
    end: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

/// How often files are looked at; one that is empty in two looks is removed. Chosen by hand: its maker needs microseconds, and a stage that
/// waits for it is taken for hung after twice as long.
const LOOK: Duration = Duration::from_millis(50);

impl EmptyFiles {
    /// Watches the files of `folder` whose names begin with `prefix`. A thread that cannot be started is told of, and not needed.
    pub(crate) fn watch(folder: PathBuf, prefix: String) -> Self {
        let (end, ended) = channel::<()>();
        let watching = move || {
            // Refused only to a thread that never had another class.
            let _ = SchedulingClass::Other.apply();
            let mut before = BTreeSet::new();
            while ended.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
                let empty = empty_files(&folder, &prefix);
                for file in empty.intersection(&before) {
                    // It may have been given a size, or have been removed, just now.
                    if is_empty(&folder.join(file)) && std::fs::remove_file(folder.join(file)).is_ok() {
                        tracing::warn!("removed {}, which its maker had left empty", file.display());
                    }
                }
                before = empty;
            }
        };
        let thread = Builder::new().name("empty-files".into()).spawn(watching);
        if let Err(error) = &thread {
            tracing::warn!("files that a process leaves empty are not removed: {error}");
        }
        Self { end: Some(end), thread: thread.ok() }
    }
}

impl Drop for EmptyFiles {
    fn drop(&mut self) {
        self.end = None;
        if let Some(thread) = self.thread.take() {
            // It does not panic.
            let _ = thread.join();
        }
    }
}

fn empty_files(folder: &Path, prefix: &str) -> BTreeSet<OsString> {
    // A folder that cannot be read now is read the next time.
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let own = entries.filter(|entry| entry.file_name().as_encoded_bytes().starts_with(prefix.as_bytes()));
    own.filter(|entry| is_empty(&entry.path())).map(|entry| entry.file_name()).collect()
}

fn is_empty(file: &Path) -> bool {
    std::fs::symlink_metadata(file).is_ok_and(|metadata| metadata.is_file() && metadata.len() == 0)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use std::time::Instant;

    #[test]
    fn what_stays_empty_is_removed_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        for name in ["coact_1_left", "coact_1_full", "coact_2_left"] {
            std::fs::write(file(name), if name == "coact_1_full" { "x" } else { "" }).unwrap();
        }
        std::fs::create_dir(file("coact_1_folder")).unwrap();
        let watched = EmptyFiles::watch(folder.path().to_owned(), "coact_1_".into());
        let begin = Instant::now();
        while file("coact_1_left").exists() && begin.elapsed() < Duration::from_secs(60) {
            // Whoever makes a file gives it a size at once.
            std::fs::write(file("coact_1_made"), "x").unwrap();
            std::thread::sleep(LOOK / 5);
            std::fs::remove_file(file("coact_1_made")).unwrap();
        }
        drop(watched);
        let left = std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name());
        let left: BTreeSet<_> = left.collect();
        let expected = ["coact_1_folder", "coact_1_full", "coact_2_left"];
        assert_eq!(left, expected.into_iter().map(OsString::from).collect());
    }

    #[test]
    fn it_ends_at_once() {
        let begin = Instant::now();
        drop(EmptyFiles::watch(std::env::temp_dir(), "coact_nobody_".into()));
        assert!(begin.elapsed() < Duration::from_secs(10));
    }
}
