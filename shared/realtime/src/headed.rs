use bytemuck::Pod;
use coact_messages::Header;
use iceoryx2::prelude::ZeroCopySend;
use std::fmt::Debug;

/// Plain memory that begins with a [`Header`]: what ports carry.
pub trait Headed: Pod + ZeroCopySend + Debug {
    /// The message's header.
    fn header(&self) -> &Header;

    /// The message's header, to be filled by the port that sends it.
    fn header_mut(&mut self) -> &mut Header;
}
