use crate::{Message, PortError, now};
use coact_messages::{Header, LAYOUT};
use iceoryx2::port::notifier::Notifier;
use iceoryx2::prelude::ipc;
use iceoryx2::sample_mut::SampleMut;
use std::ops::{Deref, DerefMut};

/// A message that is being written, in the memory that readers will see. Dropped unsent, nobody sees it.
pub struct Loan<'a, T: Message> {
    pub(crate) topic: &'a str,
    pub(crate) notifier: Option<&'a Notifier<ipc::Service>>,
    pub(crate) generation: u32,
    pub(crate) sequence: &'a mut u64,
    pub(crate) sample: SampleMut<ipc::Service, T, ()>,
}

impl<T: Message> Loan<'_, T> {
    /// Fills the header, publishes the message, and wakes who waits for it.
    ///
    /// `cycle` is the tick that produced it, `sensor_ns` the stamp of the sensor sample that it descends from.
    /// Returns the header as sent.
    ///
    /// # Errors
    /// [`PortError::Refused`].
    pub fn send(self, cycle: u64, sensor_ns: u64) -> Result<Header, PortError> {
        let Self { topic, notifier, generation, sequence, mut sample } = self;
        let header = Header {
            layout: LAYOUT,
            generation,
            sequence: *sequence,
            cycle,
            sensor_ns,
            published_ns: now(),
            reserved: 0,
        };
        *sample.payload_mut().header_mut() = header;
        sample.send().map_err(|error| PortError::refused(topic, "sending", error))?;
        *sequence += 1;
        if let Some(notifier) = notifier {
            // A listener that just died cannot be told, and need not be: nobody waits beyond the latest start.
            let _ = notifier.notify();
        }
        Ok(header)
    }

    /// Publishes the message with the header that it has.
    pub(crate) fn send_as_is(self) -> Result<(), PortError> {
        self.sample.send().map_err(|error| PortError::refused(self.topic, "sending", error))?;
        Ok(())
    }
}

impl<T: Message> Deref for Loan<'_, T> {
    type Target = T;

    fn deref(&self) -> &T {
        self.sample.payload()
    }
}

impl<T: Message> DerefMut for Loan<'_, T> {
    fn deref_mut(&mut self) -> &mut T {
        self.sample.payload_mut()
    }
}
