//! What a port can do, whatever iceoryx2 needs for it.
//!
//! A message is its bytes here, and a type again in [`Input`](crate::Input) and [`Output`](crate::Output). iceoryx2's ports are
//! generic by the message's type: named with each of them, they are compiled again for each of them, and again in each program.

use crate::{Origin, PortError};
use std::fmt::Debug;

/// Reads one topic, and keeps the newest message where its writer wrote it.
pub(crate) trait Reader: Debug {
    /// Shows `is_good` every message that has arrived, oldest first, with its origin, and keeps the last good one; the others
    /// are given back. Returns whether there was one that could not be read.
    fn receive(&mut self, is_good: &mut dyn FnMut(&[u8], Origin) -> bool) -> Result<bool, PortError>;

    /// The message that is kept.
    fn newest(&self) -> Option<&[u8]>;

    /// Sleeps until the topic's event, or for `span_ns`.
    fn wait(&self, span_ns: u64) -> Result<(), PortError>;
}

/// Writes one topic, in place.
pub(crate) trait Writer: Debug {
    /// The next message's memory: this writer's alone until it is sent, or the next one is loaned.
    fn loan(&mut self) -> Result<&mut [u8], PortError>;

    /// Publishes the loaned message; without one, nothing.
    fn send(&mut self) -> Result<(), PortError>;

    /// Wakes who waits for the topic.
    fn announce(&self);

    /// Connects to readers that joined since the last message, and hands them that message.
    fn connect_new_readers(&self) -> Result<(), PortError>;
}
