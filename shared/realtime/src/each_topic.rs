use crate::{Message, PortError};
use coact_messages::{
    Command, FieldFrame, Percept, Pulse, SensorSample, Speech, StopState, Truth, WorldState, topic,
};
use coact_pipeline::Pipeline;

/// Something that is done with each topic of a set, whatever its message.
pub(crate) trait EachTopic {
    fn topic<T: Message>(&mut self, topic: &str) -> Result<(), PortError>;
}

/// Does it: with every topic that the processes of `pipeline` write or read, except [`topic::HEARD`] and [`topic::HAND`],
/// which live as long as somebody tells something or listens.
pub(crate) fn for_each_topic(pipeline: &Pipeline, work: &mut impl EachTopic) -> Result<(), PortError> {
    work.topic::<SensorSample>(topic::SENSORS)?;
    work.topic::<Truth>(topic::TRUTH)?;
    work.topic::<Speech>(topic::SPEECH)?;
    work.topic::<StopState>(topic::STOP)?;
    with_checkpoint::<WorldState>(work, topic::WORLD_STATE)?;
    with_checkpoint::<Percept>(work, topic::PERCEPT)?;
    with_checkpoint::<FieldFrame>(work, topic::FIELDS)?;
    with_checkpoint::<Command>(work, topic::COMMAND)?;
    for process in &pipeline.processes {
        work.topic::<Pulse>(&topic::pulse(&process.name))?;
    }
    Ok(())
}

/// A topic, and the one on which its checkpoint is published.
fn with_checkpoint<T: Message>(work: &mut impl EachTopic, topic: &str) -> Result<(), PortError> {
    work.topic::<T>(topic)?;
    work.topic::<T>(&topic::resume(topic))
}
