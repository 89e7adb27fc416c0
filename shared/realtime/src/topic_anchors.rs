use crate::any_topic::{AnyTopic, message_type};
use crate::each_topic::{EachTopic, for_each_topic};
use crate::{Bus, Message, PortError, places};
use coact_messages::topic;
use coact_pipeline::Pipeline;
use iceoryx2::prelude::ipc;
use iceoryx2::service::port_factory::event;

/// Keeps all topics of a set open as long as it lives: whatever process dies, its replacement finds them.
///
/// A process that is killed while it creates a topic leaves that topic unusable. So the supervisor creates all of them
/// before it starts the first process.
#[derive(Default)]
pub struct TopicAnchors {
    topics: Vec<(String, AnyTopic)>,
    events: Vec<event::PortFactory<ipc::Service>>,
}

impl TopicAnchors {
    /// Creates every topic of a set.
    ///
    /// # Errors
    /// [`PortError::Refused`].
    pub fn new(bus: &Bus, pipeline: &Pipeline) -> Result<Self, PortError> {
        let mut creation = Creation { bus, anchors: Self::default() };
        for_each_topic(pipeline, &mut creation)?;
        Ok(creation.anchors)
    }

    /// How many topics and events are kept open.
    pub fn count(&self) -> usize {
        self.topics.len() + self.events.len()
    }

    /// In words, that a topic which `process` reads has no place left for it; `None` while all have.
    pub fn crowd(&self, process: &str) -> Option<String> {
        let read = self.topics.iter().filter(|(topic, _)| topic::reads(process, topic));
        read.filter_map(|(topic, service)| places::crowd(topic, service)).next()
    }
}

struct Creation<'a> {
    bus: &'a Bus,
    anchors: TopicAnchors,
}

impl EachTopic for Creation<'_> {
    fn topic<T: Message>(&mut self, topic: &str) -> Result<(), PortError> {
        self.anchors.topics.push((topic.to_owned(), self.bus.node().service(topic, &message_type::<T>())?));
        if topic::announces(topic) {
            self.anchors.events.push(self.bus.node().event(topic)?);
        }
        Ok(())
    }
}
