use signal_hook::consts::{SIGINT, SIGTERM, SIGUSR1};
use signal_hook::flag;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Requests that reach a process as signals: to stop (SIGTERM, SIGINT), or to be slow (SIGUSR1).
#[derive(Debug)]
pub(crate) struct Signals {
    stop: Arc<AtomicBool>,
    slow: Arc<AtomicBool>,
}

impl Signals {
    pub(crate) fn install() -> io::Result<Self> {
        let signals = Self { stop: Arc::default(), slow: Arc::default() };
        flag::register(SIGTERM, Arc::clone(&signals.stop))?;
        flag::register(SIGINT, Arc::clone(&signals.stop))?;
        flag::register(SIGUSR1, Arc::clone(&signals.slow))?;
        Ok(signals)
    }

    /// True once a signal requested that the process stops.
    pub(crate) fn stop(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// True once for each request to be slow.
    pub(crate) fn take_slow(&self) -> bool {
        self.slow.load(Ordering::Relaxed) && self.slow.swap(false, Ordering::Relaxed)
    }
}
