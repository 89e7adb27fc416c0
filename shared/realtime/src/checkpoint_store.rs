use crate::checkpoint::Checkpoint;
use crate::{Bus, PortError};
use coact_messages::{Command, FieldFrame, Header, Percept, WorldState, topic};

/// Keeps the checkpoint of every process that has one, and publishes it for the process's replacement.
///
/// What a killed writer sent lasts only as long as a reader keeps it. The supervisor is that reader.
pub struct CheckpointStore {
    world: Checkpoint<WorldState>,
    perception: Checkpoint<Percept>,
    fields: Checkpoint<FieldFrame>,
    control: Checkpoint<Command>,
}

impl CheckpointStore {
    /// Begins to read the topics.
    ///
    /// # Errors
    /// [`PortError::Refused`].
    pub fn new(bus: &Bus) -> Result<Self, PortError> {
        Ok(Self {
            world: Checkpoint::new(bus, topic::WORLD_STATE)?,
            perception: Checkpoint::new(bus, topic::PERCEPT)?,
            fields: Checkpoint::new(bus, topic::FIELDS)?,
            control: Checkpoint::new(bus, topic::COMMAND)?,
        })
    }

    /// Takes in the newest messages, and hands published checkpoints to replacements that have come up.
    ///
    /// To be called every few milliseconds while a replacement starts, otherwise as often as convenient.
    ///
    /// # Errors
    /// [`PortError::Refused`].
    pub fn poll(&mut self) -> Result<(), PortError> {
        let Self { world, perception, fields, control } = self;
        world.poll()?;
        perception.poll()?;
        fields.poll()?;
        control.poll()
    }

    /// Publishes the checkpoint of the dead `process`; to be called before its replacement is started.
    ///
    /// Returns the checkpoint's header; `None` when there is none or the process keeps no state.
    ///
    /// # Errors
    /// As [`CheckpointStore::poll`].
    pub fn publish(&mut self, process: &str) -> Result<Option<Header>, PortError> {
        match topic::state_of(process) {
            Some(topic::WORLD_STATE) => self.world.publish(),
            Some(topic::PERCEPT) => self.perception.publish(),
            Some(topic::FIELDS) => self.fields.publish(),
            Some(topic::COMMAND) => self.control.publish(),
            _ => Ok(None),
        }
    }

    /// The checkpoint of `process` that is published next is spoiled: an injected fault.
    pub fn poison(&mut self, process: &str) {
        match topic::state_of(process) {
            Some(topic::WORLD_STATE) => self.world.poison(),
            Some(topic::PERCEPT) => self.perception.poison(),
            Some(topic::FIELDS) => self.fields.poison(),
            Some(topic::COMMAND) => self.control.poison(),
            _ => {}
        }
    }

    /// The checkpoint of `process` is not published any more: replacements die of it. The process begins anew, and what it
    /// sends then is its checkpoint. Returns the dropped one's header, as [`CheckpointStore::publish`] does.
    ///
    /// # Errors
    /// As [`CheckpointStore::poll`].
    pub fn drop_newest(&mut self, process: &str) -> Result<Option<Header>, PortError> {
        match topic::state_of(process) {
            Some(topic::WORLD_STATE) => self.world.drop_newest(),
            Some(topic::PERCEPT) => self.perception.drop_newest(),
            Some(topic::FIELDS) => self.fields.drop_newest(),
            Some(topic::COMMAND) => self.control.drop_newest(),
            _ => Ok(None),
        }
    }
}
