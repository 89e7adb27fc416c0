//! What [`Slots`](super::slots::Slots) are made of, by loom: for its unit tests. Each promises less than the original, never more.

mod array_queue;
mod once_lock;

pub(super) use array_queue::ArrayQueue;
pub(super) use loom::sync::atomic::{AtomicU64, Ordering, fence};
pub(super) use loom::thread::{self, Thread};
pub(super) use once_lock::OnceLock;
