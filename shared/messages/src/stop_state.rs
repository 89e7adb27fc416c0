use crate::plausible::ensure;
use crate::{Flaw, Header, Plausible};
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// Whether an operator has stopped the robot, as the supervisor repeats it again and again.
///
/// Who drives the joints takes no message for a stop as well: after a while without one, they stand.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, Pod, Zeroable, ZeroCopySend)]
#[type_name("coact::StopState")]
pub struct StopState {
    /// Header.
    pub header: Header,
    /// 1 while the robot must stand, 0 while it may move.
    pub stopped: u32,
    /// Reserved, zero.
    pub reserved: u32,
}

impl Plausible for StopState {
    fn check(&self) -> Result<(), Flaw> {
        ensure(self.stopped <= 1, "stopped", "0 or 1")
    }
}
