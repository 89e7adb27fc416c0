use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Counts on while a search goes on: the sign of life by which another thread tells a long search from one that hangs. Clones
/// count together.
#[derive(Debug, Clone, Default)]
pub struct SearchHeartbeat(Arc<AtomicU64>);

impl SearchHeartbeat {
    /// How often it has beaten so far.
    pub fn beats(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }

    /// Beats: one atomic addition, cheap beside whatever it is called in.
    pub fn beat(&self) {
        self.0.fetch_add(1, Ordering::Relaxed);
    }
}
