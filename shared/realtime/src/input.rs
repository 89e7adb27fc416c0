use crate::monotonic_clock::now;
use crate::port::Reader;
use crate::{Headed, Message, PortError};
use coact_messages::{Header, LAYOUT};

/// Reader of one topic. It keeps the newest message where its writer wrote it: nothing is copied.
#[derive(Debug)]
pub struct Input<T: Message> {
    topic: String,
    port: Box<dyn Reader<T>>,
    received_ns: u64,
}

impl<T: Message> Input<T> {
    pub(crate) fn new(topic: &str, port: Box<dyn Reader<T>>) -> Self {
        Self { topic: topic.to_owned(), port, received_ns: 0 }
    }

    /// Takes in what has arrived, keeps the newest, and returns whether there was anything newer.
    ///
    /// Newest is the highest cycle: messages of a dead writer that are found late do not replace its successor's.
    ///
    /// # Errors
    /// [`PortError::Layout`] when the writer was built from other layouts; [`PortError::Refused`].
    pub fn refresh(&mut self) -> Result<bool, PortError> {
        let fresh = self.receive_any()?;
        match self.latest() {
            Some(message) if message.header().layout != LAYOUT => {
                Err(PortError::layout(&self.topic, message.header()))
            }
            _ => Ok(fresh),
        }
    }

    /// As [`Input::refresh`], but leaves the check of the layout to the caller.
    pub(crate) fn receive_any(&mut self) -> Result<bool, PortError> {
        let fresh = self.port.take_newest()?;
        if fresh {
            self.received_ns = now();
        }
        Ok(fresh)
    }

    /// Calls `visit` with every message that has arrived, oldest first, and keeps the last; returns how many there were.
    ///
    /// # Errors
    /// As [`Input::refresh`].
    pub fn each(&mut self, mut visit: impl FnMut(&T)) -> Result<usize, PortError> {
        let (mut count, topic) = (0, &self.topic);
        self.port.visit(&mut |message| {
            if message.header().layout != LAYOUT {
                return Err(PortError::layout(topic, message.header()));
            }
            visit(message);
            count += 1;
            Ok(())
        })?;
        Ok(count)
    }

    /// Name of the topic.
    pub fn topic(&self) -> &str {
        &self.topic
    }

    /// The newest message taken in so far, however old it is.
    pub fn latest(&self) -> Option<&T> {
        self.port.newest()
    }

    /// Its header.
    pub fn header(&self) -> Option<&Header> {
        self.latest().map(Headed::header)
    }

    /// When it was taken in, ns of `CLOCK_MONOTONIC`; 0 when none was.
    pub fn received_ns(&self) -> u64 {
        self.received_ns
    }

    /// Waits for the message of `cycle` or a later one, at the longest until `until_ns`; returns whether it is there.
    ///
    /// An event may be older than the message that it announced, or come twice: only the message itself counts.
    ///
    /// # Errors
    /// As [`Input::refresh`].
    pub fn wait_for(&mut self, cycle: u64, until_ns: u64) -> Result<bool, PortError> {
        loop {
            self.refresh()?;
            if self.header().is_some_and(|header| header.cycle >= cycle) {
                return Ok(true);
            }
            let now = now();
            if now >= until_ns {
                return Ok(false);
            }
            self.port.wait(until_ns - now)?;
        }
    }
}
