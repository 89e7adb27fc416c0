use crate::{Bus, Input, Message, Output, PortError};
use bytemuck::Zeroable;
use coact_messages::{Header, topic};

/// The newest message of one topic, kept for the replacement of its writer.
pub(crate) struct Checkpoint<T: Message> {
    newest: Input<T>,
    resume: Output<T>,
    /// Of a message that is not to be published: its readers die of it.
    dropped: Option<Header>,
    /// What is published next is spoiled: an injected fault.
    is_poisoned: bool,
}

impl<T: Message> Checkpoint<T> {
    pub(crate) fn new(bus: &Bus, topic: &str) -> Result<Self, PortError> {
        Ok(Self {
            newest: bus.input(topic)?,
            resume: bus.output(&topic::resume(topic))?,
            dropped: None,
            is_poisoned: false,
        })
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

    /// What is published next is spoiled.
    pub(crate) fn poison(&mut self) {
        self.is_poisoned = true;
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
        if std::mem::take(&mut self.is_poisoned) {
            let bytes = bytemuck::bytes_of_mut(&mut *loan);
            let half = bytes.len() / 2;
            bytes[half..].iter_mut().for_each(|byte| *byte = !*byte);
        }
        loan.send_as_is()?;
        Ok(usable.map(|message| *message.header()))
    }
}
