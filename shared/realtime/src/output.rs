use crate::{Loan, Message, PortError};
use coact_messages::Header;
use iceoryx2::port::{notifier::Notifier, publisher::Publisher, update_connections::UpdateConnections};
use iceoryx2::prelude::*;
use iceoryx2::service::port_factory::publish_subscribe;

/// Writer of one topic.
///
/// Messages are written in place: [`Output::loan`] hands out memory that readers will see, [`Loan::send`] publishes it.
#[derive(Debug)]
pub struct Output<T: Message> {
    topic: String,
    publisher: Publisher<ipc::Service, T, ()>,
    notifier: Option<Notifier<ipc::Service>>,
    generation: u32,
    sequence: u64,
}

impl<T: Message> Output<T> {
    pub(crate) fn new(
        topic: &str,
        service: &publish_subscribe::PortFactory<ipc::Service, T, ()>,
        notifier: Option<Notifier<ipc::Service>>,
        generation: u32,
    ) -> Result<Self, PortError> {
        let publisher = service
            .publisher_builder()
            // One that is being written, and one that a caller keeps by mistake: then loaning fails, with a reason.
            .max_loaned_samples(2)
            .backpressure_strategy(BackpressureStrategy::DiscardData)
            .create()
            .map_err(|error| PortError::refused(topic, "writing", error))?;
        Ok(Self { topic: topic.to_owned(), publisher, notifier, generation, sequence: 0 })
    }

    /// Name of the topic.
    pub fn topic(&self) -> &str {
        &self.topic
    }

    /// Goes on with the sequence of a predecessor's last message, so that it does not begin again at 0.
    pub fn continue_after(&mut self, last: &Header) {
        self.sequence = last.sequence + 1;
    }

    /// The next message's memory, with the contents of some earlier message or zeros.
    ///
    /// # Errors
    /// [`PortError::Refused`] when two loans are out already.
    pub fn loan(&mut self) -> Result<Loan<'_, T>, PortError> {
        let sample = self
            .publisher
            .loan_uninit()
            .map_err(|error| PortError::refused(&self.topic, "loaning a message", error))?;
        // SAFETY: the payload lies in a shared-memory segment that the kernel filled with zeros and that only
        // messages were written to since, so every byte is initialised; `T: Pod` accepts any bit pattern.
        let sample = unsafe { sample.assume_init() };
        let Self { topic, notifier, generation, sequence, .. } = self;
        Ok(Loan { topic, notifier: notifier.as_ref(), generation: *generation, sequence, sample })
    }

    /// Connects to readers that joined since the last message, and hands them that message.
    ///
    /// # Errors
    /// [`PortError::Refused`].
    pub(crate) fn connect_new_readers(&self) -> Result<(), PortError> {
        self.publisher
            .update_connections()
            .map_err(|error| PortError::refused(&self.topic, "connecting readers", error))
    }
}
