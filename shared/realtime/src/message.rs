use crate::port::{Reader, Writer};
use crate::zero_copy_reader::ZeroCopyReader;
use crate::zero_copy_writer::ZeroCopyWriter;
use crate::{Bus, Headed, PortError};
use coact_messages::{Command, FieldFrame, Percept, Pulse, SensorSample, Speech, Truth, WorldState};

/// A message whose ports can be opened.
///
/// Those of `coact_messages` are messages; one's own is made one by [`message!`](crate::message).
pub trait Message: Headed {
    /// A reader of `topic`; one that `waits` hears the topic's event.
    #[doc(hidden)]
    fn reader(bus: &Bus, topic: &str, waits: bool) -> Result<Box<dyn Reader<Self>>, PortError>;

    /// A writer of `topic`.
    #[doc(hidden)]
    fn writer(bus: &Bus, topic: &str) -> Result<Box<dyn Writer<Self>>, PortError>;
}

/// Makes structs with a field `header` messages, and compiles their ports where it stands.
#[macro_export]
macro_rules! message {
    ($($name:ident),*) => {$(
        impl $crate::Headed for $name {
            fn header(&self) -> &::coact_messages::Header {
                &self.header
            }

            fn header_mut(&mut self) -> &mut ::coact_messages::Header {
                &mut self.header
            }
        }

        impl $crate::Message for $name {
            fn reader(
                bus: &$crate::Bus,
                topic: &str,
                waits: bool,
            ) -> ::std::result::Result<::std::boxed::Box<dyn $crate::port::Reader<Self>>, $crate::PortError> {
                $crate::open_reader(bus, topic, waits)
            }

            fn writer(
                bus: &$crate::Bus,
                topic: &str,
            ) -> ::std::result::Result<::std::boxed::Box<dyn $crate::port::Writer<Self>>, $crate::PortError> {
                $crate::open_writer(bus, topic)
            }
        }
    )*};
}

message!(Command, FieldFrame, Percept, Pulse, SensorSample, Speech, Truth, WorldState);

/// See [`Message::reader`].
#[doc(hidden)]
pub fn open_reader<T: Headed>(bus: &Bus, topic: &str, waits: bool) -> Result<Box<dyn Reader<T>>, PortError> {
    Ok(Box::new(ZeroCopyReader::open(bus, topic, waits)?))
}

/// See [`Message::writer`].
#[doc(hidden)]
pub fn open_writer<T: Headed>(bus: &Bus, topic: &str) -> Result<Box<dyn Writer<T>>, PortError> {
    Ok(Box::new(ZeroCopyWriter::open(bus, topic)?))
}
