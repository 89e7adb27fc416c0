//! A topic as iceoryx2 sees it, whatever its message.

use crate::Message;
use iceoryx2::prelude::ipc;
use iceoryx2::service::marker::{CustomHeaderMarker, CustomPayloadMarker};
use iceoryx2::service::port_factory::publish_subscribe::PortFactory;
use iceoryx2::service::static_config::message_type_details::{TypeDetail, TypeVariant};

/// iceoryx2's bytes of a message: their number and alignment, and the message's name, are told when a topic is opened.
pub(crate) type Bytes = [CustomPayloadMarker];
/// iceoryx2's place for a header of one's own: ours has no size, our [`Header`](coact_messages::Header) is in the message.
pub(crate) type NoHeader = CustomHeaderMarker;
/// An open topic.
pub(crate) type AnyTopic = PortFactory<ipc::Service, Bytes, NoHeader>;

/// What iceoryx2 has to know of a message: its size, alignment and name.
pub(crate) fn message_type<T: Message>() -> TypeDetail {
    TypeDetail::new::<T>(TypeVariant::FixedSize)
}

/// The same of the header that is none; a program that names the message's type expects it so.
pub(crate) fn header_type() -> TypeDetail {
    TypeDetail::new::<()>(TypeVariant::FixedSize)
}
