use coact_messages::{Command, FieldFrame, Percept, SensorSample, Truth};

/// The newest message of each sort, as far as there are any.
#[derive(Debug, Clone, Copy, Default)]
pub struct Seen<'a> {
    /// What the sensors tell.
    pub sample: Option<&'a SensorSample>,
    /// What perception makes of it.
    pub percept: Option<&'a Percept>,
    /// The network.
    pub frame: Option<&'a FieldFrame>,
    /// What control commands.
    pub command: Option<&'a Command>,
    /// What the simulation knows; a real workplace has none.
    pub truth: Option<&'a Truth>,
}

impl Seen<'_> {
    /// The newest cycle that any of them tells of; none when there are none.
    pub fn cycle(&self) -> Option<u64> {
        let cycles = [
            self.sample.map(|message| message.header.cycle),
            self.percept.map(|message| message.header.cycle),
            self.frame.map(|message| message.header.cycle),
        ];
        cycles.into_iter().flatten().max()
    }
}
