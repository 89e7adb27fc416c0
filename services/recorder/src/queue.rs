use coact_run_recording::Recorded;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

/// Messages that wait to be written take no more than this, bytes: some two seconds of a run. A disk that stands still for longer
/// costs messages, which are counted. A trade-off, chosen by hand.
const MOST: usize = 64 << 20;

/// What is on its way to the file.
pub(crate) enum Item {
    /// A message.
    Message(Recorded),
    /// The end: how many messages were lost, by topic.
    End(BTreeMap<String, u64>),
}

/// Where messages are put in.
pub(crate) struct QueueIn {
    items: Sender<Item>,
    bytes: Arc<AtomicUsize>,
}

/// Where they are taken out.
pub(crate) struct QueueOut {
    items: Receiver<Item>,
    bytes: Arc<AtomicUsize>,
}

/// A queue between who listens, who must never wait, and who writes, who waits for the disk.
pub(crate) fn queue() -> (QueueIn, QueueOut) {
    let ((sender, receiver), bytes) = (channel(), Arc::new(AtomicUsize::new(0)));
    (QueueIn { items: sender, bytes: bytes.clone() }, QueueOut { items: receiver, bytes })
}

impl QueueIn {
    /// Puts a message in; false when there is no room, or nobody who writes.
    pub fn put(&self, message: Recorded) -> bool {
        let size = message.bytes().len();
        if self.bytes.load(Ordering::Relaxed) + size > MOST {
            return false;
        }
        self.bytes.fetch_add(size, Ordering::Relaxed);
        self.items.send(Item::Message(message)).is_ok()
    }

    /// Nothing comes any more.
    pub fn end(self, lost: BTreeMap<String, u64>) {
        // Refused when nobody writes any more: then there is no end to be written.
        self.items.send(Item::End(lost)).ok();
    }
}

impl QueueOut {
    /// The next item; `None` when none came within this time.
    ///
    /// # Errors
    /// Who put in is gone.
    pub fn take(&self, within: Duration) -> Result<Option<Item>, RecvTimeoutError> {
        match self.items.recv_timeout(within) {
            Ok(item) => {
                if let Item::Message(message) = &item {
                    self.bytes.fetch_sub(message.bytes().len(), Ordering::Relaxed);
                }
                Ok(Some(item))
            }
            Err(RecvTimeoutError::Timeout) => Ok(None),
            Err(gone) => Err(gone),
        }
    }
}
