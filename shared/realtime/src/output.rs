use crate::port::Writer;
use crate::{Loan, Message, PortError};
use coact_messages::Header;

/// Writer of one topic.
///
/// Messages are written in place: [`Output::loan`] hands out memory that readers will see, [`Loan::send`] publishes it.
#[derive(Debug)]
pub struct Output<T: Message> {
    topic: String,
    pub(crate) port: Box<dyn Writer<T>>,
    pub(crate) generation: u32,
    pub(crate) sequence: u64,
}

impl<T: Message> Output<T> {
    pub(crate) fn new(topic: &str, port: Box<dyn Writer<T>>, generation: u32) -> Self {
        Self { topic: topic.to_owned(), port, generation, sequence: 0 }
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
        let message = self.port.loan()?;
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
