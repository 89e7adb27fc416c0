use crate::{BenchError, SlowCycle, StageTimes};
use coact_messages::{Pulse, topic};
use coact_monitor::histogram;
use coact_pipeline::Run;
use coact_realtime::Bus;
use hdrhistogram::Histogram;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Keeps the slowest cycles of a run, from the pulses of its chain, and counts those in which every stage published.
#[derive(Debug)]
pub struct SlowCycles {
    /// The chain, in its order.
    chain: Vec<String>,
    /// What the stages did in the newest cycles.
    recent: BTreeMap<u64, Recent>,
    /// The slowest ones so far, the slowest first.
    slowest: Vec<SlowCycle>,
    /// From sensor sample to command, ns, in cycles in which every stage published: none of them was dead then.
    whole: Histogram<u64>,
}

/// What is known of a cycle so far.
#[derive(Debug)]
struct Recent {
    stages: Vec<Option<StageTimes>>,
    end_to_end_ns: Option<u64>,
}

/// So many cycles are kept.
const KEPT: usize = 20;
/// Cycles that are no farther apart belong to one stall or one death, which is kept once, by its slowest cycle.
const ONE_EVENT: u64 = 100;
/// A look at the pulses comes this often; queues hold half a second of them.
const LOOK_EVERY: Duration = Duration::from_millis(20);
/// So many cycles are remembered until all of their pulses have come: a few looks.
const REMEMBERED: u64 = 200;

impl SlowCycles {
    /// Of this chain.
    pub fn new(chain: Vec<String>) -> Self {
        Self { chain, recent: BTreeMap::new(), slowest: Vec::new(), whole: histogram() }
    }

    /// Watches a run until it is over.
    ///
    /// # Errors
    /// [`BenchError::Watch`].
    pub fn watch(&mut self, run: &Run, over: &AtomicBool) -> Result<(), BenchError> {
        let bus = Bus::open(run, "bench", 0)?;
        let inputs = self.chain.iter().map(|process| bus.input::<Pulse>(&topic::pulse(process)));
        let mut inputs = inputs.collect::<Result<Vec<_>, _>>()?;
        while !over.load(Ordering::Relaxed) {
            std::thread::sleep(LOOK_EVERY);
            // The last stage comes last: its pulse finds those of the others.
            for (stage, input) in inputs.iter_mut().enumerate() {
                input.each(|pulse| self.add(stage, pulse))?;
            }
        }
        self.judge_before(u64::MAX);
        Ok(())
    }

    /// Takes in a pulse of the stage at this place of the chain.
    pub fn add(&mut self, stage: usize, pulse: &Pulse) {
        let cycle = pulse.header.cycle;
        let unknown = || Recent { stages: vec![None; self.chain.len()], end_to_end_ns: None };
        let recent = self.recent.entry(cycle).or_insert_with(unknown);
        recent.stages[stage] = Some(StageTimes::of(&self.chain[stage], pulse));
        if stage + 1 == self.chain.len() && pulse.header.sensor_ns > 0 {
            recent.end_to_end_ns = Some(pulse.header.published_ns.saturating_sub(pulse.header.sensor_ns));
        }
        self.judge_before(cycle.saturating_sub(REMEMBERED));
    }

    /// The slowest cycles, the slowest first, and how long the way took in whole cycles.
    pub fn finish(mut self) -> (Vec<SlowCycle>, Histogram<u64>) {
        self.judge_before(u64::MAX);
        (self.slowest, self.whole)
    }

    /// Of the cycles before this one no pulse will come any more.
    fn judge_before(&mut self, cycle: u64) {
        let younger = self.recent.split_off(&cycle);
        for (cycle, recent) in std::mem::replace(&mut self.recent, younger) {
            let Some(end_to_end_ns) = recent.end_to_end_ns else { continue };
            if recent.stages.iter().all(Option::is_some) {
                self.whole.saturating_record(end_to_end_ns);
            }
            self.keep(SlowCycle {
                cycle,
                end_to_end_ns,
                stages: recent.stages.into_iter().flatten().collect(),
            });
        }
    }

    fn keep(&mut self, cycle: SlowCycle) {
        let near = self.slowest.iter().position(|kept| kept.cycle.abs_diff(cycle.cycle) <= ONE_EVENT);
        if near.is_some_and(|near| self.slowest[near].end_to_end_ns >= cycle.end_to_end_ns) {
            return;
        }
        near.map(|near| self.slowest.remove(near));
        let place = self.slowest.partition_point(|kept| kept.end_to_end_ns >= cycle.end_to_end_ns);
        if place < KEPT {
            self.slowest.insert(place, cycle);
            self.slowest.truncate(KEPT);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use coact_messages::Header;

    fn pulse(cycle: u64, took: u64) -> Pulse {
        let (released_ns, sensor_ns) = (1_000_000 * cycle, 1_000_000 * cycle + 10);
        let header = Header { cycle, sensor_ns, published_ns: sensor_ns + took, ..Header::default() };
        Pulse {
            header,
            released_ns,
            started_ns: released_ns + 5,
            scheduled_ns: released_ns,
            ..Pulse::default()
        }
    }

    #[test]
    fn the_slowest_cycle_of_each_event_is_kept_in_order_with_all_of_its_stages() {
        let mut cycles = SlowCycles::new(vec!["world".into(), "control".into()]);
        for cycle in 1..=9000 {
            if cycle != 7 {
                cycles.add(0, &pulse(cycle, 1));
            }
            cycles.add(1, &pulse(cycle, if cycle % 300 < 3 { cycle + cycle % 300 } else { 1 }));
        }
        assert!(cycles.recent.len() <= REMEMBERED as usize + 1);
        let (slowest, whole) = cycles.finish();
        let found: Vec<u64> = slowest.iter().map(|cycle| cycle.cycle).collect();
        let last_of_each: Vec<u64> =
            (0..20).map(|event| 9000 - 300 * event + if event == 0 { 0 } else { 2 }).collect();
        assert_eq!(found, last_of_each);
        assert_eq!(slowest[0].stages[1].published_ns, 9000 + 10);
        assert_eq!(slowest[0].stages.len(), 2);
        assert_eq!(whole.len(), 8999, "in cycle 7 the world was dead");
    }
}
