//! What a port can do, whatever iceoryx2 needs for it.
//!
//! iceoryx2's ports are generic by the message's type, and a program that names one compiles all of it again: 15 s of a
//! core for each of our programs. Behind these traits they are compiled once for each message, in this crate.

use crate::PortError;
use std::fmt::Debug;
use std::ptr::NonNull;

/// Reads one topic, and keeps the newest message where its writer wrote it.
pub trait Reader<T>: Debug {
    /// Takes in all that has arrived, keeps the message of the highest cycle; returns whether there was anything newer.
    fn take_newest(&mut self) -> Result<bool, PortError>;

    /// Shows `visit` every message that has arrived, oldest first, and keeps the last; ends with the first error.
    fn visit(&mut self, visit: &mut dyn FnMut(&T) -> Result<(), PortError>) -> Result<(), PortError>;

    /// The message that is kept.
    fn newest(&self) -> Option<&T>;

    /// Sleeps until the topic's event, or for `span_ns`.
    fn wait(&self, span_ns: u64) -> Result<(), PortError>;
}

/// Writes one topic, in place.
pub trait Writer<T>: Debug {
    /// The next message's memory: this writer's alone until it is sent, or the next one is loaned.
    fn loan(&mut self) -> Result<NonNull<T>, PortError>;

    /// Publishes the loaned message; without one, nothing.
    fn send(&mut self) -> Result<(), PortError>;

    /// Wakes who waits for the topic.
    fn announce(&self);

    /// Connects to readers that joined since the last message, and hands them that message.
    fn connect_new_readers(&self) -> Result<(), PortError>;
}
