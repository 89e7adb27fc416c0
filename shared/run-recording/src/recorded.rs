use bytemuck::{Pod, bytes_of, bytes_of_mut, zeroed_box};
use coact_messages::{Command, FieldFrame, Header, Percept, Pulse, SensorSample, Speech, Truth, topic};

/// One message of a run, with the bits that it had.
#[derive(Debug, Clone)]
pub enum Recorded {
    /// What the sensors told.
    Sample(Box<SensorSample>),
    /// What perception made of it.
    Percept(Box<Percept>),
    /// The network, and its decision.
    Frame(Box<FieldFrame>),
    /// Setpoints of the joints.
    Command(Box<Command>),
    /// The accounts of one cycle of a process.
    Pulse {
        /// Name of the process.
        process: String,
        /// Its pulse.
        pulse: Box<Pulse>,
    },
    /// What the robot said.
    Speech(Box<Speech>),
    /// What the simulation knew and no sensor told; recordings of before it was recorded have none.
    Truth(Box<Truth>),
}

impl Recorded {
    /// The topic that it was heard on.
    pub fn topic(&self) -> String {
        match self {
            Self::Sample(_) => topic::SENSORS.to_owned(),
            Self::Percept(_) => topic::PERCEPT.to_owned(),
            Self::Frame(_) => topic::FIELDS.to_owned(),
            Self::Command(_) => topic::COMMAND.to_owned(),
            Self::Pulse { process, .. } => topic::pulse(process),
            Self::Speech(_) => topic::SPEECH.to_owned(),
            Self::Truth(_) => topic::TRUTH.to_owned(),
        }
    }

    /// Its bytes.
    pub fn bytes(&self) -> &[u8] {
        match self {
            Self::Sample(sample) => bytes_of(&**sample),
            Self::Percept(percept) => bytes_of(&**percept),
            Self::Frame(frame) => bytes_of(&**frame),
            Self::Command(command) => bytes_of(&**command),
            Self::Pulse { pulse, .. } => bytes_of(&**pulse),
            Self::Speech(speech) => bytes_of(&**speech),
            Self::Truth(truth) => bytes_of(&**truth),
        }
    }

    /// Its header.
    pub fn header(&self) -> &Header {
        match self {
            Self::Sample(sample) => &sample.header,
            Self::Percept(percept) => &percept.header,
            Self::Frame(frame) => &frame.header,
            Self::Command(command) => &command.header,
            Self::Pulse { pulse, .. } => &pulse.header,
            Self::Speech(speech) => &speech.header,
            Self::Truth(truth) => &truth.header,
        }
    }

    /// The message of a topic; `None` when it has another size, or the topic's messages are not recorded.
    pub(crate) fn read(name: &str, bytes: &[u8]) -> Option<Self> {
        match name {
            topic::SENSORS => boxed(bytes).map(Self::Sample),
            topic::PERCEPT => boxed(bytes).map(Self::Percept),
            topic::FIELDS => boxed(bytes).map(Self::Frame),
            topic::COMMAND => boxed(bytes).map(Self::Command),
            topic::SPEECH => boxed(bytes).map(Self::Speech),
            topic::TRUTH => boxed(bytes).map(Self::Truth),
            _ => {
                let process = name.strip_prefix(&topic::pulse(""))?.to_owned();
                boxed(bytes).map(|pulse| Self::Pulse { process, pulse })
            }
        }
    }
}

fn boxed<T: Pod>(bytes: &[u8]) -> Option<Box<T>> {
    if bytes.len() != size_of::<T>() {
        return None;
    }
    let mut message = zeroed_box::<T>();
    bytes_of_mut(&mut *message).copy_from_slice(bytes);
    Some(message)
}
