use crate::RequestedFault;
use crate::pending_fault::PendingFault;
use std::time::Duration;

/// Drop-outs of the sensors that injected faults request; the process that has the sensors does them.
#[derive(Debug)]
pub struct DropOuts {
    /// As in [`Signals`](crate::signals::Signals).
    pub(crate) fault: PendingFault,
}

impl DropOuts {
    /// Once for each request: for how long the cameras show nothing.
    pub fn take(&self) -> Option<Duration> {
        self.fault.take(RequestedFault::drop_out)
    }
}
