//! For the whole-system tests: a set of real processes, started as a person starts it.
//!
//! The programs are taken from the folder that this workspace builds into: `cargo build --workspace --bins` first,
//! as `tools/test` does.
#![allow(clippy::unwrap_used, reason = "a library of tests: what fails, fails the test")]

mod alone;
mod browser;
mod course;
mod ended_with_test;
mod finished;
mod joint_viewer;
mod launched;
mod operate;
mod paths;
mod thread_faults;
mod tracer;

pub use alone::alone;
pub use browser::Browser;
pub use course::Course;
pub use ended_with_test::EndedWithTest;
pub use finished::Finished;
pub use joint_viewer::JointViewer;
pub use launched::Launched;
pub use operate::operate;
pub use paths::{checkout, coact, left_behind, shared_memory};
pub use thread_faults::ThreadFaults;
pub use tracer::{TraceError, Tracer};

use std::time::{Duration, Instant};

/// Longer than anything that is waited for takes on a busy machine: a whole assembly lasts up to 300 s.
const TIMEOUT: Duration = Duration::from_secs(400);

/// Chosen by hand; not sensitive.
const POLL_INTERVAL: Duration = Duration::from_millis(5);

/// Polls until there is a value.
///
/// # Panics
/// After a while without one; `what` says what was waited for.
pub fn wait_for<T>(what: &str, poll: impl FnMut() -> Option<T>) -> T {
    wait_within(TIMEOUT, what, poll)
}

/// The same, but no longer than this.
///
/// # Panics
/// As [`wait_for`].
pub fn wait_within<T>(most: Duration, what: &str, mut poll: impl FnMut() -> Option<T>) -> T {
    let begin = Instant::now();
    loop {
        if let Some(found) = poll() {
            return found;
        }
        assert!(begin.elapsed() < most, "timed out: {what}");
        std::thread::sleep(POLL_INTERVAL);
    }
}
