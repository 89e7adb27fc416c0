use coact_messages::{
    Command, Described, Description, FieldFrame, Percept, Pulse, SensorSample, Speech, Truth, topic,
};

/// The messages that a recording holds as they are.
pub(crate) struct MessageKind {
    /// Name of the message's type.
    pub name: &'static str,
    pub description: Description,
}

impl MessageKind {
    /// That of a topic; `None` for one that is not recorded.
    pub(crate) fn of(topic: &str) -> Option<Self> {
        let name = topic::find(topic)?.message;
        let description = match name {
            "SensorSample" => SensorSample::description(),
            "Percept" => Percept::description(),
            "FieldFrame" => FieldFrame::description(),
            "Command" => Command::description(),
            "Pulse" => Pulse::description(),
            "Speech" => Speech::description(),
            "Truth" => Truth::description(),
            _ => return None,
        };
        Some(Self { name, description })
    }
}
