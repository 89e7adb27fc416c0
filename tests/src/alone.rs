use std::sync::{Mutex, MutexGuard, PoisonError};

static ONE_TEST_AT_A_TIME: Mutex<()> = Mutex::new(());

/// Held by a test that others of its file would disturb: sets share the cores of the chain.
pub fn alone() -> MutexGuard<'static, ()> {
    ONE_TEST_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner)
}
