use crate::pending_fault::PendingFault;
use crate::{DropOuts, RequestedFault};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Requests that reach a process as signals: to stop (SIGTERM, SIGINT), or to do a fault to itself ([`RequestedFault`]).
#[derive(Debug)]
pub(crate) struct Signals {
    stop: Arc<AtomicBool>,
    fault: PendingFault,
    background_freezes: Arc<AtomicBool>,
}

impl Signals {
    pub(crate) fn install() -> io::Result<Self> {
        let signals =
            Self { stop: Arc::default(), fault: PendingFault::default(), background_freezes: Arc::default() };
        flag::register(SIGTERM, Arc::clone(&signals.stop))?;
        flag::register(SIGINT, Arc::clone(&signals.stop))?;
        let freeze = RequestedFault::FreezePlanner.signal();
        flag::register(freeze, Arc::clone(&signals.background_freezes))?;
        for (fault, number) in RequestedFault::ALL.into_iter().zip(1..) {
            flag::register_usize(fault.signal(), Arc::clone(&signals.fault.number), number)?;
        }
        Ok(signals)
    }

    /// True once a signal requested that the process stops. One that was requested to end by a fault ends here.
    pub(crate) fn stop(&self) -> bool {
        if let Some(fault) = self.fault.look() {
            fault.end();
        }
        self.stop.load(Ordering::Relaxed)
    }

    /// Set once the background work is to stand still.
    pub(crate) fn background_freezes(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.background_freezes)
    }

    /// Requests that the sensors drop out.
    pub(crate) fn drop_outs(&self) -> DropOuts {
        DropOuts { fault: self.fault.clone() }
    }

    /// Once for each request to be slow: by how much.
    pub(crate) fn take_slowdown(&self) -> Option<Duration> {
        self.fault.take(RequestedFault::slowdown)
    }
}
