use crate::{Bus, Input, Message, Output, PortError};
use bytemuck::Zeroable;
use coact_messages::{Header, topic};

/// The newest message of one topic, kept for the replacement of its writer.
pub(crate) struct Checkpoint<T: Message> {
    newest: Input<T>,
    resume: Output<T>,
    /// Of a message that is not to be published: its readers die of it.
    dropped: Option<Header>,
}

impl<T: Message> Checkpoint<T> {
    pub(crate) fn new(bus: &Bus, topic: &str) -> Result<Self, PortError> {
        Ok(Self { newest: bus.input(topic)?, resume: bus.output(&topic::resume(topic))?, dropped: None })
    }

    /// Takes in the newest message; a reader that joined since gets what was published last.
    pub(crate) fn poll(&mut self) -> Result<(), PortError> {
        self.newest.refresh()?;
        self.resume.connect_new_readers()
    }

    /// The newest message is never published again; returns its header.
    pub(crate) fn drop_newest(&mut self) -> Result<Option<Header>, PortError> {
        self.newest.refresh()?;
        self.dropped = self.newest.header().copied();
        Ok(self.dropped)
    }

    /// Publishes the newest message on the topic's resume topic; returns its header.
    pub(crate) fn publish(&mut self) -> Result<Option<Header>, PortError> {
        self.newest.refresh()?;
        let mut loan = self.resume.loan()?;
        let usable = self.newest.latest().filter(|message| Some(*message.header()) != self.dropped);
        match usable {
            Some(message) => *loan = *message,
            // Says at once that there is no checkpoint, instead of letting the replacement wait.
            None => *loan.header_mut() = Header::zeroed(),
        }
        loan.send_as_is()?;
        Ok(usable.map(|message| *message.header()))
    }
}
