use crate::RequestedFault;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The newest fault that a signal has requested and nobody has done yet. Signals may come at any time, while it is taken too.
#[derive(Debug, Clone, Default)]
pub(crate) struct PendingFault {
    /// 0, or one more than the index of the fault in [`RequestedFault::ALL`].
    pub(crate) number: Arc<AtomicUsize>,
}

impl PendingFault {
    /// The fault, which stays.
    pub(crate) fn look(&self) -> Option<RequestedFault> {
        RequestedFault::numbered(self.number.load(Ordering::Relaxed))
    }

    /// Once for each request: what `of` makes of the fault. Where that is nothing, the fault stays for who can do it.
    pub(crate) fn take<T>(&self, of: impl FnOnce(RequestedFault) -> Option<T>) -> Option<T> {
        let number = self.number.load(Ordering::Relaxed);
        let taken = of(RequestedFault::numbered(number)?)?;
        // A request that has come since is another one, and stays.
        _ = self.number.compare_exchange(number, 0, Ordering::Relaxed, Ordering::Relaxed);
        Some(taken)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pending(fault: usize) -> PendingFault {
        let pending = PendingFault::default();
        pending.number.store(fault, Ordering::Relaxed);
        pending
    }

    #[test]
    fn a_request_is_taken_once_by_who_can_do_it() {
        let pending = pending(5);
        assert_eq!(pending.look(), Some(RequestedFault::Slow));
        assert_eq!(pending.take(RequestedFault::drop_out), None);
        assert!(pending.take(RequestedFault::slowdown).is_some());
        assert_eq!(pending.take(RequestedFault::slowdown), None);
    }

    #[test]
    fn a_request_that_comes_while_another_one_is_taken_is_not_lost() {
        let pending = pending(5);
        let taken = pending.take(|fault| {
            pending.number.store(9, Ordering::Relaxed);
            fault.slowdown()
        });
        assert!(taken.is_some());
        assert_eq!(pending.look(), Some(RequestedFault::DropOut));
    }
}
