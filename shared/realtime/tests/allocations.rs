//! Reading allocates nothing. What a whole cycle allocates is tested beside the executor.
#![allow(clippy::unwrap_used)]

mod support;

use allocation_counter::measure;
use coact_messages::{SensorSample, topic};
use coact_realtime::{Bus, Input, Output};
use support::TestRun;

/// Cycles in which connections are made and buffers reach their size.
const WARM_UP: u64 = 20;
const CYCLES: u64 = 200;

#[test]
fn reading_allocates_nothing() {
    let run = TestRun::started();
    let bus = Bus::open(&run.0, "fields", 0).unwrap();
    let mut input: Input<SensorSample> = bus.trigger(topic::SENSORS).unwrap();
    let mut output: Output<SensorSample> = bus.output(topic::SENSORS).unwrap();
    for cycle in 1..=WARM_UP + CYCLES {
        output.loan().unwrap().send(cycle, 0).unwrap();
        let count = measure(|| assert!(input.wait_for(cycle, u64::MAX).unwrap())).count_total;
        if cycle > WARM_UP {
            assert_eq!(count, 0, "in cycle {cycle}");
        }
    }
}
