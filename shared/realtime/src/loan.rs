use crate::{Message, Output, PortError, now};
use coact_messages::{Header, LAYOUT};
use std::ops::{Deref, DerefMut};
use std::ptr::NonNull;

/// A message that is being written, in the memory that readers will see. Dropped unsent, nobody sees it.
pub struct Loan<'a, T: Message> {
    pub(crate) output: &'a mut Output<T>,
    /// The message that the output's port has loaned. It is the port's until it is sent or another one is loaned; both need
    /// the output, which is borrowed as long as this lives.
    pub(crate) message: NonNull<T>,
}

impl<T: Message> Loan<'_, T> {
    /// Fills the header, publishes the message, and wakes who waits for it.
    ///
    /// `cycle` is the tick that produced it, `sensor_ns` the stamp of the sensor sample that it descends from.
    /// Returns the header as sent.
    ///
    /// # Errors
    /// [`PortError::Refused`].
    pub fn send(mut self, cycle: u64, sensor_ns: u64) -> Result<Header, PortError> {
        let header = Header {
            layout: LAYOUT,
            generation: self.output.generation,
            sequence: self.output.sequence,
            cycle,
            sensor_ns,
            published_ns: now(),
            reserved: 0,
        };
        *self.header_mut() = header;
        self.output.port.send()?;
        self.output.sequence += 1;
        self.output.port.announce();
        Ok(header)
    }

    /// Publishes the message with the header that it has.
    pub(crate) fn send_as_is(self) -> Result<(), PortError> {
        self.output.port.send()
    }
}

impl<T: Message> Deref for Loan<'_, T> {
    type Target = T;

    fn deref(&self) -> &T {
        // SAFETY: the port keeps the loaned message as long as this lives, and nobody else refers to it.
        unsafe { self.message.as_ref() }
    }
}

impl<T: Message> DerefMut for Loan<'_, T> {
    fn deref_mut(&mut self) -> &mut T {
        // SAFETY: as above; this is borrowed mutably, so there is no other reference.
        unsafe { self.message.as_mut() }
    }
}
