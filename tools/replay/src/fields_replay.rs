use crate::stage_replay::Stage;
use coact_fields::Network;
use coact_messages::{FieldFrame, Percept};

/// The network, with the frame that the next one is computed from.
pub(crate) struct FieldsReplay {
    network: Network,
    previous: Box<FieldFrame>,
}

impl FieldsReplay {
    pub fn new(network: Network) -> Self {
        let mut replay = Self { network, previous: bytemuck::zeroed_box() };
        replay.begin_anew();
        replay
    }
}

impl Stage for FieldsReplay {
    type Input = Percept;
    type Output = FieldFrame;

    fn begin_anew(&mut self) {
        bytemuck::bytes_of_mut(&mut *self.previous).fill(0);
        self.network.rest(&mut self.previous);
    }

    fn resume(&mut self, last: &FieldFrame) {
        match self.network.fits(last) {
            true => *self.previous = *last,
            false => self.begin_anew(),
        }
    }

    fn step(&mut self, cycle: u64, input: Option<&Percept>, out: &mut FieldFrame) {
        self.network.step(cycle, input, &self.previous, out);
        *self.previous = *out;
    }
}
