use crate::any_topic::message_type;
use crate::each_topic::{EachTopic, for_each_topic};
use crate::{Bus, Message, PortError};
use coact_messages::topic;
use coact_pipeline::{Pipeline, Run};
use std::any::Any;

/// Reserves what the replacement of a process will need of each topic: a place among its readers, and one among those who
/// have it open. Dropped just before the replacement is started, it makes room for it: whoever else reads, the set's own
/// processes find their places.
pub struct Reservation {
    // Declared before the bus: ports close before their node.
    ports: Vec<Box<dyn Any>>,
    process: String,
    bus: Bus,
}

impl Reservation {
    /// Takes the places for the replacement of `process`.
    ///
    /// # Errors
    /// [`PortError::Refused`] when others have taken them.
    pub fn take(run: &Run, pipeline: &Pipeline, process: &str) -> Result<Self, PortError> {
        let bus = Bus::open(run, &format!("{process}-reservation"), 0)?;
        let mut reservation = Self { ports: Vec::new(), process: process.to_owned(), bus };
        for_each_topic(pipeline, &mut reservation)?;
        Ok(reservation)
    }
}

impl EachTopic for Reservation {
    fn topic<T: Message>(&mut self, topic: &str) -> Result<(), PortError> {
        // The reader is never read: what it does not take gives way to what is newer.
        if topic::reads(&self.process, topic) {
            self.ports.push(Box::new(self.bus.port(topic, &message_type::<T>(), false)?));
        } else if topic::writes(&self.process, topic) {
            self.ports.push(Box::new(self.bus.node().service(topic, &message_type::<T>())?));
        }
        Ok(())
    }
}
