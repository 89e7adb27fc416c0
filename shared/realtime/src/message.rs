use crate::port::Portable;
use bytemuck::Pod;
use coact_messages::{Command, FieldFrame, Header, Percept, Pulse, SensorSample, Speech, Truth, WorldState};
use iceoryx2::prelude::ZeroCopySend;

/// A message that ports can carry: plain memory that begins with a [`Header`].
///
/// Those of `coact_messages` are; one's own is made one by [`message!`](crate::message).
pub trait Message: Pod + ZeroCopySend + std::fmt::Debug + Portable {
    /// The message's header.
    fn header(&self) -> &Header;
    /// The message's header, to be filled by the port that sends it.
    fn header_mut(&mut self) -> &mut Header;
}

/// Makes structs with a field `header` messages, and compiles their ports where it stands.
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

        impl $crate::port::Portable for $name {
            fn reader(
                bus: &$crate::Bus,
                topic: &str,
                waits: bool,
            ) -> ::std::result::Result<::std::boxed::Box<dyn $crate::port::Reader<Self>>, $crate::PortError> {
                $crate::port::open_reader(bus, topic, waits)
            }

            fn writer(
                bus: &$crate::Bus,
                topic: &str,
            ) -> ::std::result::Result<::std::boxed::Box<dyn $crate::port::Writer<Self>>, $crate::PortError> {
                $crate::port::open_writer(bus, topic)
            }

            fn anchor(
                bus: &$crate::Bus,
                topic: &str,
            ) -> ::std::result::Result<::std::boxed::Box<dyn ::std::any::Any>, $crate::PortError> {
                $crate::port::open_anchor::<Self>(bus, topic)
            }
        }
    )*};
}

message!(Command, FieldFrame, Percept, Pulse, SensorSample, Speech, Truth, WorldState);
