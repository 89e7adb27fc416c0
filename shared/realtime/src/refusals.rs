use coact_messages::{NONE, Refusal, topic};
use std::sync::atomic::{AtomicU32, Ordering};

/// How many messages the ports of one process have ignored, and why. Each pulse of the process carries it.
#[derive(Debug)]
pub struct Refusals {
    counts: [AtomicU32; Refusal::COUNT],
    /// The topic of the newest: index into [`topic::ALL`].
    topic: AtomicU32,
}

impl Default for Refusals {
    fn default() -> Self {
        Self { counts: Default::default(), topic: AtomicU32::new(NONE) }
    }
}

impl Refusals {
    /// Counts a message of `topic`, an index into [`topic::ALL`] or [`NONE`].
    pub fn count(&self, topic: u32, refusal: Refusal) {
        self.counts[refusal as usize].fetch_add(1, Ordering::Relaxed);
        self.topic.store(topic, Ordering::Relaxed);
    }

    /// The counts so far, by the number of their [`Refusal`].
    pub fn counts(&self) -> [u32; Refusal::COUNT] {
        std::array::from_fn(|refusal| self.counts[refusal].load(Ordering::Relaxed))
    }

    /// The topic of the newest: index into [`topic::ALL`], or [`NONE`].
    pub fn topic(&self) -> u32 {
        self.topic.load(Ordering::Relaxed)
    }
}

/// Index of `name` in [`topic::ALL`], or [`NONE`].
pub(crate) fn topic_index(name: &str) -> u32 {
    topic::ALL.iter().position(|entry| entry.covers(name)).map_or(NONE, |index| index as u32)
}
