use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// Version of all message layouts; a receiver ignores a message of another one.
pub const LAYOUT: u32 = 15;

/// What every message begins with. 48 bytes; times are ns of `CLOCK_MONOTONIC`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable, ZeroCopySend)]
pub struct Header {
    /// [`LAYOUT`] of the sender.
    pub layout: u32,
    /// How often the sending process was restarted in this run; 0 for the first start.
    pub generation: u32,
    /// Messages sent on this topic by this sender before this one, restarts included.
    pub sequence: u64,
    /// Cycle (1 ms tick) that produced the message, counted from the start of the run.
    pub cycle: u64,
    /// Stamp of the sensor sample that this message descends from.
    pub sensor_ns: u64,
    /// Stamp of the message's own publication.
    pub published_ns: u64,
    /// Reserved, zero.
    pub reserved: u64,
}
