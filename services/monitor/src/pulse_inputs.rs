use coact_messages::{Pulse, topic};
use coact_realtime::{Bus, Input, PortError};

/// The pulses of several processes of a run.
pub struct PulseInputs {
    inputs: Vec<(String, Input<Pulse>)>,
    /// What was read and not told yet: of which of them, and the pulse.
    read: Vec<(usize, Pulse)>,
}

impl PulseInputs {
    /// Opens those of these processes.
    ///
    /// # Errors
    /// [`PortError`].
    pub fn open(bus: &Bus, processes: impl IntoIterator<Item = String>) -> Result<Self, PortError> {
        let open = |process: String| Ok((process.clone(), bus.input(&topic::pulse(&process))?));
        let inputs = processes.into_iter().map(open).collect::<Result<_, PortError>>()?;
        Ok(Self { inputs, read: Vec::new() })
    }

    /// Tells all pulses that have come since it was asked last, each with its process, in the order of the outputs that they tell of.
    ///
    /// # Errors
    /// As [`Input::each`]; what was read by then is told the next time.
    pub fn each(&mut self, mut visit: impl FnMut(&str, &Pulse)) -> Result<(), PortError> {
        let Self { inputs, read } = self;
        for (index, (_, input)) in inputs.iter_mut().enumerate() {
            input.each(|pulse| read.push((index, *pulse)))?;
        }
        sort(read);
        read.drain(..).for_each(|(index, pulse)| visit(&inputs[index].0, &pulse));
        Ok(())
    }
}

/// Where a stage and its standby have both sent for a cycle, their readers have taken the first message: so does who counts.
fn sort(pulses: &mut [(usize, Pulse)]) {
    pulses.sort_by_key(|(_, pulse)| pulse.header.published_ns);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Metrics, PipelineNode};
    use coact_period::PERIOD_NS;
    use std::time::Duration;

    fn node(process: &str) -> PipelineNode {
        PipelineNode { process: process.into(), input_from: None, last: false }
    }

    /// What the process tells of a cycle, `after` ns from its release.
    fn pulse(cycle: u64, generation: u32, after: u64) -> Pulse {
        let mut pulse = Pulse { released_ns: cycle * PERIOD_NS, ..Pulse::default() };
        (pulse.header.cycle, pulse.header.sequence, pulse.header.generation) = (cycle, cycle, generation);
        pulse.header.published_ns = pulse.released_ns + after;
        pulse.missed = u64::from(after > PERIOD_NS);
        pulse
    }

    #[test]
    fn what_a_replacement_sends_late_is_no_outage_where_its_standby_had_sent_in_time() {
        const NAMES: [&str; 2] = ["fields", "fields-standby"];
        let mut metrics = Metrics::new(NAMES.map(node).into(), Duration::from_millis(50));
        // As they are read: one topic after the other. The stage died after cycle 1, its replacement begins with cycle 4.
        let mut read = vec![(0, pulse(0, 0, 100)), (0, pulse(1, 0, 100)), (0, pulse(4, 1, PERIOD_NS + 1))];
        read.extend((0..=5).map(|cycle| (1, pulse(cycle, 0, 150))));
        sort(&mut read);
        for (index, pulse) in &read {
            metrics.pulse(NAMES[*index], pulse);
        }
        let counted = metrics.counters()["fields"].outage.until(6);
        assert_eq!((counted.due, counted.without_output), (6, 0));
    }
}
