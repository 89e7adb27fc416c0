use bytemuck::Pod;
use coact_messages::{
    Command, FieldFrame, HandPoints, Header, Percept, Plausible, Pulse, SensorSample, Speech, StopState,
    Truth, WorldState,
};
use iceoryx2::prelude::ZeroCopySend;
use std::fmt::Debug;

/// Plain memory that begins with a [`Header`], and can be judged: what ports carry.
///
/// The structs of `coact_messages` are messages; one's own is made one by [`message!`](crate::message).
pub trait Message: Pod + ZeroCopySend + Debug + Plausible {
    /// The message's header.
    fn header(&self) -> &Header;

    /// The message's header, to be filled by the port that sends it.
    fn header_mut(&mut self) -> &mut Header;
}

/// Makes structs with a field `header` messages.
#[macro_export]
macro_rules! message {
    ($($name:ident),*) => {$(
        impl $crate::Message for $name {
            fn header(&self) -> &::coact_messages::Header {
                &self.header
            }

            fn header_mut(&mut self) -> &mut ::coact_messages::Header {
                &mut self.header
            }
        }
    )*};
}

message!(Command, FieldFrame, HandPoints, Percept, Pulse, SensorSample, Speech, StopState, Truth, WorldState);
