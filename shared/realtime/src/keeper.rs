use crate::{Bus, Input, Message, Output, PortError};
use bytemuck::Zeroable;
use coact_messages::{Command, FieldFrame, Header, Percept, WorldState, topic};

/// Holds the newest message of every process that has a memory, and offers it to the process's replacement.
///
/// What a killed writer had sent survives where a reader holds it, and nowhere else. The supervisor is that reader.
pub struct Keeper {
    world: Kept<WorldState>,
    perception: Kept<Percept>,
    fields: Kept<FieldFrame>,
    control: Kept<Command>,
}

impl Keeper {
    /// Begins to keep.
    ///
    /// # Errors
    /// [`PortError::Refused`].
    pub fn new(bus: &Bus) -> Result<Self, PortError> {
        Ok(Self {
            world: Kept::new(bus, topic::WORLD_STATE)?,
            perception: Kept::new(bus, topic::PERCEPT)?,
            fields: Kept::new(bus, topic::FIELDS)?,
            control: Kept::new(bus, topic::COMMAND)?,
        })
    }

    /// Takes in the newest messages and hands offers to replacements that have come up.
    ///
    /// To be called every few milliseconds while a replacement starts, otherwise as often as convenient.
    ///
    /// # Errors
    /// [`PortError::Refused`] or [`PortError::Layout`].
    pub fn poll(&mut self) -> Result<(), PortError> {
        let Self { world, perception, fields, control } = self;
        world.poll()?;
        perception.poll()?;
        fields.poll()?;
        control.poll()
    }

    /// Offers the newest message of the dead `process` to its replacement; to be called before that is started.
    ///
    /// Answers its header; `None` when nothing survived or the process has no memory.
    ///
    /// # Errors
    /// As [`Keeper::poll`].
    pub fn offer(&mut self, process: &str) -> Result<Option<Header>, PortError> {
        match topic::state_of(process) {
            Some(topic::WORLD_STATE) => self.world.offer(),
            Some(topic::PERCEPT) => self.perception.offer(),
            Some(topic::FIELDS) => self.fields.offer(),
            Some(topic::COMMAND) => self.control.offer(),
            _ => Ok(None),
        }
    }
}

struct Kept<T: Message> {
    newest: Input<T>,
    offer: Output<T>,
}

impl<T: Message> Kept<T> {
    fn new(bus: &Bus, topic: &str) -> Result<Self, PortError> {
        Ok(Self { newest: bus.input(topic)?, offer: bus.output(&topic::resume(topic))? })
    }

    fn poll(&mut self) -> Result<(), PortError> {
        self.newest.refresh()?;
        self.offer.greet()
    }

    fn offer(&mut self) -> Result<Option<Header>, PortError> {
        self.newest.refresh()?;
        let mut loan = self.offer.loan()?;
        match self.newest.latest() {
            Some(message) => *loan = *message,
            // Says at once that nothing survived, instead of letting the replacement wait.
            None => *loan.header_mut() = Header::zeroed(),
        }
        loan.send_as_is()?;
        Ok(self.newest.header().copied())
    }
}
