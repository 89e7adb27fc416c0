use crate::port::Writer;
use crate::{Loan, Message, PortError};
use coact_messages::Header;
use std::marker::PhantomData;
use std::ptr::NonNull;

/// Writer of one topic.
///
/// Messages are written in place: [`Output::loan`] hands out memory that readers will see, [`Loan::send`] publishes it.
#[derive(Debug)]
pub struct Output<T: Message> {
    topic: String,
    pub(crate) port: Box<dyn Writer>,
    pub(crate) generation: u32,
    pub(crate) sequence: u64,
    message: PhantomData<T>,
}

impl<T: Message> Output<T> {
    pub(crate) fn new(topic: &str, port: Box<dyn Writer>, generation: u32) -> Self {
        Self { topic: topic.to_owned(), port, generation, sequence: 0, message: PhantomData }
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
    /// [`PortError::Refused`] when readers hold all memory that there is.
    pub fn loan(&mut self) -> Result<Loan<'_, T>, PortError> {
        let message = bytemuck::try_from_bytes_mut(self.port.loan()?)
            .map_err(|error| PortError::refused(&self.topic, "loaning a message", error))?;
        let message = NonNull::from(message);
        Ok(Loan { output: self, message })
    }

    /// Connects to readers that joined since the last message, and hands them that message.
    ///
    /// # Errors
    /// [`PortError::Refused`].
    pub(crate) fn connect_new_readers(&self) -> Result<(), PortError> {
        self.port.connect_new_readers()
    }
}
