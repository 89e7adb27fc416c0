use coact_messages::{Description, Header};
use serde::Serialize;

/// Where a message that was computed again is not what was recorded.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Difference {
    /// The topic.
    pub topic: &'static str,
    /// Cycle of the message.
    pub cycle: u64,
    /// How often its process had been restarted.
    pub generation: u32,
    /// Its sequence.
    pub sequence: u64,
    /// The first number of the message that differs, as in `workspace[1].position[3][0]`.
    pub field: String,
    /// Offset of the first byte that differs.
    pub byte: usize,
}

impl Difference {
    /// The first one between two messages of a topic; `None` when they are equal.
    pub(crate) fn between(
        topic: &'static str,
        header: &Header,
        recorded: &[u8],
        computed: &[u8],
        description: &Description,
    ) -> Option<Self> {
        let byte = recorded.iter().zip(computed).position(|(recorded, computed)| recorded != computed)?;
        let Header { cycle, generation, sequence, .. } = *header;
        Some(Self { topic, cycle, generation, sequence, field: description.place(byte), byte })
    }
}
