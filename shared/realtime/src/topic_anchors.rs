use crate::{Bus, Message, PortError};
use coact_messages::{Command, FieldFrame, Percept, Pulse, SensorSample, Speech, Truth, WorldState, topic};
use coact_pipeline::Pipeline;
use std::any::Any;

/// Keeps all topics of a set open as long as it lives: whatever process dies, its replacement finds them.
///
/// A process that is killed while it creates a topic leaves that topic unusable. So the supervisor creates all of them
/// before it starts the first process.
pub struct TopicAnchors {
    services: Vec<Box<dyn Any>>,
}

impl TopicAnchors {
    /// Creates every topic of a set.
    ///
    /// # Errors
    /// [`PortError::Refused`].
    pub fn new(bus: &Bus, pipeline: &Pipeline) -> Result<Self, PortError> {
        let mut anchors = Self { services: Vec::new() };
        anchors.add::<SensorSample>(bus, topic::SENSORS)?;
        anchors.add::<Truth>(bus, topic::TRUTH)?;
        anchors.add::<Speech>(bus, topic::SPEECH)?;
        anchors.add_with_checkpoint::<WorldState>(bus, topic::WORLD_STATE)?;
        anchors.add_with_checkpoint::<Percept>(bus, topic::PERCEPT)?;
        anchors.add_with_checkpoint::<FieldFrame>(bus, topic::FIELDS)?;
        anchors.add_with_checkpoint::<Command>(bus, topic::COMMAND)?;
        for process in &pipeline.processes {
            anchors.add::<Pulse>(bus, &topic::pulse(&process.name))?;
        }
        Ok(anchors)
    }

    /// How many topics and events are kept open.
    pub fn count(&self) -> usize {
        self.services.len()
    }

    /// A topic, and the one on which its checkpoint is published.
    fn add_with_checkpoint<T: Message>(&mut self, bus: &Bus, topic: &str) -> Result<(), PortError> {
        self.add::<T>(bus, topic)?;
        self.add::<T>(bus, &topic::resume(topic))
    }

    fn add<T: Message>(&mut self, bus: &Bus, topic: &str) -> Result<(), PortError> {
        self.services.push(Box::new(bus.service::<T>(topic)?));
        if topic::announces(topic) {
            self.services.push(Box::new(bus.event(topic)?));
        }
        Ok(())
    }
}
