use loom::sync::atomic::{AtomicPtr, Ordering};
use std::ptr::null_mut;

/// A place for one value, as crossbeam's `ArrayQueue` of one. Whether it is empty may be seen late, unless something else tells of
/// the value that was put there.
#[derive(Debug)]
pub(crate) struct ArrayQueue<T>(AtomicPtr<T>);

impl<T> ArrayQueue<T> {
    /// Of one place.
    pub fn new(places: usize) -> Self {
        assert_eq!(places, 1);
        Self(AtomicPtr::new(null_mut()))
    }

    pub fn force_push(&self, value: T) -> Option<T> {
        owned(self.0.swap(Box::into_raw(Box::new(value)), Ordering::AcqRel))
    }

    pub fn pop(&self) -> Option<T> {
        if self.0.load(Ordering::Acquire).is_null() {
            return None;
        }
        owned(self.0.swap(null_mut(), Ordering::AcqRel))
    }
}

fn owned<T>(value: *mut T) -> Option<T> {
    // SAFETY: a pointer is null or of `Box::into_raw`, and whoever swaps it out is the only one that has it.
    (!value.is_null()).then(|| *unsafe { Box::from_raw(value) })
}

impl<T> Drop for ArrayQueue<T> {
    fn drop(&mut self) {
        owned(self.0.swap(null_mut(), Ordering::AcqRel));
    }
}
