use bytemuck::Pod;
use coact_messages::{Header, Plausible};
use iceoryx2::prelude::ZeroCopySend;
use std::fmt::Debug;

/// Plain memory that begins with a [`Header`], and can be judged: what ports carry.
pub trait Headed: Pod + ZeroCopySend + Debug + Plausible {
    /// The message's header.
    fn header(&self) -> &Header;

    /// The message's header, to be filled by the port that sends it.
    fn header_mut(&mut self) -> &mut Header;
}
