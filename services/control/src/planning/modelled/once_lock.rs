use loom::sync::atomic::{AtomicPtr, Ordering};
use std::ptr::null_mut;

/// A value that is set once, as the standard library's.
#[derive(Debug)]
pub(crate) struct OnceLock<T>(AtomicPtr<T>);

impl<T> OnceLock<T> {
    pub fn new() -> Self {
        Self(AtomicPtr::new(null_mut()))
    }

    /// Only to be called once.
    pub fn set(&self, value: T) -> Result<(), T> {
        self.0.store(Box::into_raw(Box::new(value)), Ordering::Release);
        Ok(())
    }

    pub fn get(&self) -> Option<&T> {
        // SAFETY: the pointer is null or of `Box::into_raw`, and is freed by `drop` alone.
        unsafe { self.0.load(Ordering::Acquire).as_ref() }
    }
}

impl<T> Drop for OnceLock<T> {
    fn drop(&mut self) {
        let value = self.0.load(Ordering::Acquire);
        if !value.is_null() {
            // SAFETY: of `Box::into_raw`, and nobody else has it any more.
            drop(unsafe { Box::from_raw(value) });
        }
    }
}
