use crate::port::Writer;
use crate::{Bus, Headed, PortError};
use coact_messages::topic;
use iceoryx2::port::{notifier::Notifier, publisher::Publisher, update_connections::UpdateConnections};
use iceoryx2::prelude::{BackpressureStrategy, ipc};
use iceoryx2::sample_mut::SampleMut;
use std::ptr::NonNull;

/// A writer over iceoryx2.
#[derive(Debug)]
pub(crate) struct ZeroCopyWriter<T: Headed> {
    topic: String,
    // Declared before the publisher: the message is given back before the port closes.
    loaned: Option<SampleMut<ipc::Service, T, ()>>,
    publisher: Publisher<ipc::Service, T, ()>,
    notifier: Option<Notifier<ipc::Service>>,
}

impl<T: Headed> ZeroCopyWriter<T> {
    pub fn open(bus: &Bus, topic: &str) -> Result<Self, PortError> {
        let service = bus.service::<T>(topic)?;
        let notifier = match topic::announces(topic) {
            true => Some(bus.event(topic)?.notifier_builder().create()),
            false => None,
        };
        let notifier =
            notifier.transpose().map_err(|error| PortError::refused(topic, "opening its event", error))?;
        let publisher = service
            .publisher_builder()
            .max_loaned_samples(1)
            .backpressure_strategy(BackpressureStrategy::DiscardData)
            .create()
            .map_err(|error| PortError::refused(topic, "writing", error))?;
        Ok(Self { topic: topic.to_owned(), loaned: None, publisher, notifier })
    }
}

impl<T: Headed> Writer<T> for ZeroCopyWriter<T> {
    fn loan(&mut self) -> Result<NonNull<T>, PortError> {
        self.loaned = None;
        let sample = self.publisher.loan_uninit();
        let sample = sample.map_err(|error| PortError::refused(&self.topic, "loaning a message", error))?;
        // SAFETY: the payload lies in a shared-memory segment that the kernel filled with zeros and that only
        // messages were written to since, so every byte is initialised; `T: Pod` accepts any bit pattern.
        let sample = self.loaned.insert(unsafe { sample.assume_init() });
        Ok(NonNull::from(sample.payload_mut()))
    }

    fn send(&mut self) -> Result<(), PortError> {
        let Some(sample) = self.loaned.take() else { return Ok(()) };
        sample.send().map_err(|error| PortError::refused(&self.topic, "sending", error))?;
        Ok(())
    }

    fn announce(&self) {
        if let Some(notifier) = &self.notifier {
            // A listener that just died cannot be told, and need not be: nobody waits beyond the latest start.
            let _ = notifier.notify();
        }
    }

    fn connect_new_readers(&self) -> Result<(), PortError> {
        let connected = self.publisher.update_connections();
        connected.map_err(|error| PortError::refused(&self.topic, "connecting readers", error))
    }
}
