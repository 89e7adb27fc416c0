//! What the whole-system tests share: a set of real processes, started as a person starts it.
//!
//! The programs are taken from the folder that this workspace builds into: `cargo build --workspace --bins` first,
//! as `tools/test` does.
#![allow(clippy::unwrap_used, reason = "a library of tests: what fails, fails the test")]

mod finished;
mod launched;
mod places;

pub use finished::Finished;
pub use launched::Launched;
pub use places::{checkout, coact, left_behind, shared_memory};

use std::time::{Duration, Instant};

/// Longer than anything that is waited for may take on a loaded machine.
const PATIENCE: Duration = Duration::from_secs(400);

/// Looks until there is something to see.
///
/// # Panics
/// It never came; `what` says what.
pub fn wait_for<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let begin = Instant::now();
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(begin.elapsed() < PATIENCE, "it never came: {what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}
