use crate::RequestedFault;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// Drop-outs of the sensors that injected faults request; the process that has the sensors does them.
#[derive(Debug)]
pub struct DropOuts {
    /// As in [`Signals`](crate::signals::Signals).
    pub(crate) fault: Arc<AtomicUsize>,
}

impl DropOuts {
    /// Once for each request: for how long the cameras show nothing.
    pub fn take(&self) -> Option<Duration> {
        let duration = RequestedFault::numbered(self.fault.load(Ordering::Relaxed))?.drop_out()?;
        self.fault.store(0, Ordering::Relaxed);
        Some(duration)
    }
}
