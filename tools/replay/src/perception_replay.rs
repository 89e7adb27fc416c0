use crate::stage_replay::Stage;
use coact_messages::{Percept, SensorSample};
use coact_perception::Perception;

/// Perception, to be begun anew.
pub(crate) struct PerceptionReplay {
    fresh: Perception,
    perception: Perception,
}

impl PerceptionReplay {
    pub fn new(fresh: Perception) -> Self {
        Self { perception: fresh.clone(), fresh }
    }
}

impl Stage for PerceptionReplay {
    type Input = SensorSample;
    type Output = Percept;

    fn begin_anew(&mut self) {
        self.perception = self.fresh.clone();
    }

    fn resume(&mut self, last: &Percept) {
        self.begin_anew();
        // What it refuses it leaves, and begins anew: as in the run.
        self.perception.resume(last).ok();
    }

    fn step(&mut self, cycle: u64, input: Option<&SensorSample>, out: &mut Percept) {
        self.perception.step(cycle, input, out);
    }
}
