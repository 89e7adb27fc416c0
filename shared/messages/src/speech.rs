use crate::Header;
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// A sentence that the robot says (on occasion).
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
#[type_name("coact::Speech")]
pub struct Speech {
    /// Header; `cycle` is that of the field frame that the sentence was composed from.
    pub header: Header,
    /// Bytes of `text` that are valid.
    pub length: u64,
    /// The sentence, UTF-8.
    pub text: [u8; 256],
}
