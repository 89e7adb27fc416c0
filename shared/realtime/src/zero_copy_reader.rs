use crate::any_topic::{Bytes, NoHeader};
use crate::monotonic_clock::timespec;
use crate::port::Reader;
use crate::run_node::{MAX_WRITERS, RunNode};
use crate::{Origin, PortError, places};
use coact_messages::topic;
use iceoryx2::port::{ReceiveError, listener::Listener, port_name::PortName, subscriber::Subscriber};
use iceoryx2::prelude::{FileDescriptorBased, PayloadHeader, ipc};
use iceoryx2::sample::Sample;
use iceoryx2::service::static_config::message_type_details::TypeDetail;
use rustix::event::{PollFd, PollFlags, poll};
use rustix::io::Errno;
use std::os::fd::BorrowedFd;
use std::thread;
use std::time::Duration;

/// A wait that the kernel refuses, as it does to a process that may have no file handles, looks again after this time. Chosen by hand: it delays
/// a message by less than a tenth of a cycle, and leaves the core to the others for most of it.
const LOOKS_AGAIN: Duration = Duration::from_micros(50);

/// A reader over iceoryx2.
#[derive(Debug)]
pub(crate) struct ZeroCopyReader {
    topic: String,
    // Declared before the subscriber: the message is given back before the port closes.
    newest: Option<Sample<ipc::Service, Bytes, NoHeader>>,
    subscriber: Subscriber<ipc::Service, Bytes, NoHeader>,
    listener: Option<Listener<ipc::Service>>,
    /// So many messages are taken in at one look: all that the queues of all writers hold, so that who sends without end keeps
    /// no reader from its cycle.
    most: usize,
}

impl ZeroCopyReader {
    pub fn open(node: &RunNode, topic: &str, kind: &TypeDetail, waits: bool) -> Result<Self, PortError> {
        let listener = match waits {
            true => Some(node.event(topic)?.listener_builder().create()),
            false => None,
        };
        let listener = listener.transpose().map_err(|error| PortError::refused(topic, "listening", error))?;
        let service = node.service(topic, kind)?;
        places::admit(topic, node.process(), &service)?;
        // By its name a reader is known for one of the set, or for a viewer.
        let name = PortName::new(node.process());
        let name = name.map_err(|error| PortError::refused(topic, "naming", error))?;
        let subscriber = service.subscriber_builder().name(&name).create();
        let subscriber = subscriber.map_err(|error| PortError::refused(topic, "reading", error))?;
        let most = MAX_WRITERS * topic::depth(topic);
        Ok(Self { topic: topic.to_owned(), newest: None, subscriber, listener, most })
    }
}

impl Reader for ZeroCopyReader {
    fn receive(&mut self, is_good: &mut dyn FnMut(&[u8], Origin) -> bool) -> Result<bool, PortError> {
        let mut unreadable = false;
        for _ in 0..self.most {
            let sample = match self.subscriber.receive() {
                Ok(Some(sample)) => sample,
                Ok(None) => break,
                // A sender whose memory is gone or cannot be mapped: the other senders can still be heard.
                Err(ReceiveError::ConnectionFailure(_)) => return Ok(true),
                Err(error) => return Err(PortError::refused(&self.topic, "receiving", error)),
            };
            let origin = Origin {
                publisher: sample.origin().value(),
                pid: sample.header().node_id().pid::<ipc::Service>().map_or(0, |pid| pid.value() as u32),
            };
            // Its sender says how many messages it holds: with another number than one it is none.
            if sample.header().number_of_elements() != 1 {
                unreadable = true;
                continue;
            }
            if is_good(bytes(&sample), origin) {
                self.newest = Some(sample);
            }
        }
        Ok(unreadable)
    }

    fn newest(&self) -> Option<&[u8]> {
        self.newest.as_deref().map(bytes)
    }

    /// iceoryx2's own waits round up to whole milliseconds.
    fn wait(&self, span_ns: u64) -> Result<(), PortError> {
        let Some(listener) = &self.listener else {
            return Err(PortError::refused(&self.topic, "waiting", "the input was not opened as a trigger"));
        };
        // SAFETY: the descriptor belongs to the listener, which outlives this call and keeps it open.
        let socket = unsafe { BorrowedFd::borrow_raw(listener.file_descriptor().native_handle()) };
        // An interrupted poll is a spurious wake-up, as is one that failed: the caller looks for the message and the time. It must not do so
        // without end, though: on one core with it, the stages below it would never get on.
        match poll(&mut [PollFd::new(&socket, PollFlags::IN)], Some(&timespec(span_ns))) {
            Ok(_) | Err(Errno::INTR) => {}
            Err(_) => thread::sleep(LOOKS_AGAIN.min(Duration::from_nanos(span_ns))),
        }
        listener.try_wait(|_| {}).map_err(|error| PortError::refused(&self.topic, "waiting", error))?;
        Ok(())
    }
}

fn bytes(payload: &Bytes) -> &[u8] {
    // SAFETY: the marker is one byte, of any value.
    unsafe { &*(std::ptr::from_ref(payload) as *const [u8]) }
}
