use crate::{Bus, Message, PortError};
use coact_messages::{Command, FieldFrame, Percept, Pulse, SensorSample, Speech, Truth, WorldState, topic};
use coact_pipeline::Pipeline;
use std::any::Any;

/// All topics of a set, kept usable as long as this lives: whatever dies, a replacement finds them.
pub struct Held {
    services: Vec<Box<dyn Any>>,
}

impl Held {
    pub(crate) fn new(bus: &Bus, pipeline: &Pipeline) -> Result<Self, PortError> {
        let mut held = Self { services: Vec::new() };
        held.hold::<SensorSample>(bus, topic::SENSORS)?;
        held.hold::<Truth>(bus, topic::TRUTH)?;
        held.hold::<Speech>(bus, topic::SPEECH)?;
        held.hold_state::<WorldState>(bus, topic::WORLD_STATE)?;
        held.hold_state::<Percept>(bus, topic::PERCEPT)?;
        held.hold_state::<FieldFrame>(bus, topic::FIELDS)?;
        held.hold_state::<Command>(bus, topic::COMMAND)?;
        for process in &pipeline.processes {
            held.hold::<Pulse>(bus, &topic::pulse(&process.name))?;
        }
        Ok(held)
    }

    /// How many topics and events are held.
    pub fn count(&self) -> usize {
        self.services.len()
    }

    fn hold_state<T: Message>(&mut self, bus: &Bus, topic: &str) -> Result<(), PortError> {
        self.hold::<T>(bus, topic)?;
        self.hold::<T>(bus, &topic::resume(topic))
    }

    fn hold<T: Message>(&mut self, bus: &Bus, topic: &str) -> Result<(), PortError> {
        self.services.push(Box::new(bus.service::<T>(topic)?));
        if topic::announces(topic) {
            self.services.push(Box::new(bus.event(topic)?));
        }
        Ok(())
    }
}
