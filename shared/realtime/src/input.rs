use crate::monotonic_clock::{now, timespec};
use crate::{Message, PortError};
use coact_messages::{Header, LAYOUT};
use iceoryx2::port::{listener::Listener, subscriber::Subscriber};
use iceoryx2::prelude::*;
use iceoryx2::sample::Sample;
use iceoryx2::service::port_factory::publish_subscribe;
use rustix::event::{PollFd, PollFlags, poll};
use std::os::fd::BorrowedFd;

/// Reader of one topic. It keeps the newest message where its writer wrote it: nothing is copied.
#[derive(Debug)]
pub struct Input<T: Message> {
    topic: String,
    // Declared before the subscriber: the message is given back before the port closes.
    newest: Option<Sample<ipc::Service, T, ()>>,
    subscriber: Subscriber<ipc::Service, T, ()>,
    listener: Option<Listener<ipc::Service>>,
    received_ns: u64,
}

impl<T: Message> Input<T> {
    pub(crate) fn new(
        topic: &str,
        service: &publish_subscribe::PortFactory<ipc::Service, T, ()>,
        listener: Option<Listener<ipc::Service>>,
    ) -> Result<Self, PortError> {
        let subscriber = service
            .subscriber_builder()
            .create()
            .map_err(|error| PortError::refused(topic, "reading", error))?;
        Ok(Self { topic: topic.to_owned(), newest: None, subscriber, listener, received_ns: 0 })
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
        let mut fresh = false;
        while let Some(sample) = self.receive()? {
            if self.latest().is_none_or(|newest| Message::header(&*sample).cycle >= newest.header().cycle) {
                self.newest = Some(sample);
                fresh = true;
            }
        }
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
        let mut count = 0;
        while let Some(sample) = self.receive()? {
            if Message::header(&*sample).layout != LAYOUT {
                return Err(PortError::layout(&self.topic, Message::header(&*sample)));
            }
            visit(&sample);
            self.newest = Some(sample);
            count += 1;
        }
        Ok(count)
    }

    /// Name of the topic.
    pub fn topic(&self) -> &str {
        &self.topic
    }

    /// The newest message taken in so far, however old it is.
    pub fn latest(&self) -> Option<&T> {
        self.newest.as_deref()
    }

    /// Its header.
    pub fn header(&self) -> Option<&Header> {
        self.latest().map(Message::header)
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
            self.wait_for_event(until_ns - now)?;
        }
    }

    /// Sleeps until the topic's event or for `span_ns`. iceoryx2's own waits round up to whole milliseconds.
    fn wait_for_event(&self, span_ns: u64) -> Result<(), PortError> {
        let Some(listener) = &self.listener else {
            return Err(PortError::refused(&self.topic, "waiting", "the input was not opened as a trigger"));
        };
        // SAFETY: the descriptor belongs to the listener, which outlives this call and keeps it open.
        let socket = unsafe { BorrowedFd::borrow_raw(listener.file_descriptor().native_handle()) };
        // An interrupted or failed poll is a spurious wake-up: the caller looks for the message and the time.
        let _ = poll(&mut [PollFd::new(&socket, PollFlags::IN)], Some(&timespec(span_ns)));
        listener.try_wait(|_| {}).map_err(|error| PortError::refused(&self.topic, "waiting", error))?;
        Ok(())
    }

    fn receive(&self) -> Result<Option<Sample<ipc::Service, T, ()>>, PortError> {
        self.subscriber.receive().map_err(|error| PortError::refused(&self.topic, "receiving", error))
    }
}
