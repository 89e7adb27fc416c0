use crate::any_topic::{Bytes, NoHeader};
use crate::port::Writer;
use crate::run_node::RunNode;
use crate::{PortError, handles_left};
use coact_messages::topic;
use iceoryx2::port::update_connections::UpdateConnections;
use iceoryx2::port::{DegradationAction, notifier::Notifier, publisher::Publisher};
use iceoryx2::prelude::{BackpressureStrategy, ipc};
use iceoryx2::sample_mut::SampleMut;
use iceoryx2::service::static_config::message_type_details::TypeDetail;

/// A writer over iceoryx2.
#[derive(Debug)]
pub(crate) struct ZeroCopyWriter {
    topic: String,
    // Declared before the publisher: the message is given back before the port closes.
    loaned: Option<SampleMut<ipc::Service, Bytes, NoHeader>>,
    publisher: Publisher<ipc::Service, Bytes, NoHeader>,
    notifier: Option<Notifier<ipc::Service>>,
}

impl ZeroCopyWriter {
    pub fn open(node: &RunNode, topic: &str, kind: &TypeDetail) -> Result<Self, PortError> {
        let service = node.service(topic, kind)?;
        let notifier = match topic::announces(topic) {
            true => Some(node.event(topic)?.notifier_builder().create()),
            false => None,
        };
        let notifier =
            notifier.transpose().map_err(|error| PortError::refused(topic, "opening its event", error))?;
        let publisher = service
            .publisher_builder()
            .max_loaned_samples(1)
            .backpressure_strategy(BackpressureStrategy::DiscardData)
            .set_degradation_handler(|_, _| unconnected())
            .create()
            .map_err(|error| PortError::refused(topic, "writing", error))?;
        Ok(Self { topic: topic.to_owned(), loaned: None, publisher, notifier })
    }
}

impl ZeroCopyWriter {
    fn failed(&self, operation: &'static str, problem: impl std::fmt::Debug) -> PortError {
        match handles_left() {
            Ok(()) => PortError::refused(&self.topic, operation, problem),
            Err(cause) => PortError::NoHandles { topic: self.topic.clone(), cause },
        }
    }
}

impl Writer for ZeroCopyWriter {
    fn loan(&mut self) -> Result<&mut [u8], PortError> {
        self.loaned = None;
        // SAFETY: one message at a time, of the size that the topic was opened with.
        let sample = unsafe { self.publisher.loan_custom_payload(1) };
        let sample = sample.map_err(|error| PortError::refused(&self.topic, "loaning a message", error))?;
        // SAFETY: the payload lies in a shared-memory segment that the kernel filled with zeros and that only
        // messages without padding were written to since, so every byte is initialised.
        let sample = self.loaned.insert(unsafe { sample.assume_init() });
        let bytes: *mut Bytes = sample.payload_mut();
        // SAFETY: the marker is one byte, of any value, and the memory is borrowed as long as this writer.
        Ok(unsafe { &mut *(bytes as *mut [u8]) })
    }

    fn send(&mut self) -> Result<(), PortError> {
        let Some(sample) = self.loaned.take() else { return Ok(()) };
        sample.send().map_err(|error| self.failed("sending", error))?;
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
        connected.map_err(|error| self.failed("connecting readers", error))
    }
}

/// What becomes of a writer that cannot be connected to a reader. One that has just died is missed by nobody; but iceoryx2 tries only
/// once, and a reader that was missed for want of a handle would never hear of this writer.
fn unconnected() -> DegradationAction {
    match handles_left() {
        Ok(()) => DegradationAction::Warn,
        Err(_) => DegradationAction::DegradeAndFail,
    }
}
