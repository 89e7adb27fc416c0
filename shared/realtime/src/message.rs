use bytemuck::Pod;
use coact_messages::{Command, FieldFrame, Header, Percept, Pulse, SensorSample, Speech, Truth, WorldState};
use iceoryx2::prelude::ZeroCopySend;

/// A message that ports can carry: plain memory that begins with a [`Header`].
pub trait Message: Pod + ZeroCopySend + std::fmt::Debug {
    /// The message's header.
    fn header(&self) -> &Header;
    /// The message's header, to be filled by the port that sends it.
    fn header_mut(&mut self) -> &mut Header;
}

macro_rules! message {
    ($($name:ident),*) => {$(
        impl Message for $name {
            fn header(&self) -> &Header {
                &self.header
            }
            fn header_mut(&mut self) -> &mut Header {
                &mut self.header
            }
        }
    )*};
}

message!(Command, FieldFrame, Percept, Pulse, SensorSample, Speech, Truth, WorldState);
