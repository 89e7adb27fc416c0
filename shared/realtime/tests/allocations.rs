//! A steady cycle allocates what iceoryx2 does for each loan, and nothing else.
#![allow(clippy::unwrap_used)]

mod support;

use allocation_counter::measure;
use coact_messages::{Command, Header, SensorSample, topic};
use coact_realtime::{Cycle, Input, Output, PortError, Process, Tick};
use support::TestRun;

/// Cycles in which connections are made and buffers reach their size.
const WARM_UP: u64 = 20;
const CYCLES: u64 = 200;
/// The cycle's own output, and its pulse.
const LOANS: u64 = 2;

/// A trivial stage that stops its process after so many cycles, and counts the allocations within each of its steps.
struct Counted<'a> {
    command: Input<Command>,
    sample: Output<SensorSample>,
    cycles: usize,
    counts: &'a mut Vec<u64>,
}

impl Cycle for Counted<'_> {
    type Trigger = Command;

    fn trigger(&mut self) -> &mut Input<Command> {
        &mut self.command
    }

    fn step(&mut self, tick: Tick) -> Result<Header, PortError> {
        let mut sent = Ok(Header::default());
        let count = measure(|| {
            sent = self.sample.loan().and_then(|mut sample| {
                sample.joints.touch = tick.cycle as f64;
                sample.send(tick.cycle, tick.started_ns)
            });
        });
        self.counts.push(count.count_total);
        if self.counts.len() == self.cycles {
            // SAFETY: sends this process the signal that the executor handles as a request to stop.
            unsafe { libc::raise(libc::SIGTERM) };
        }
        sent
    }
}

/// Allocations of a whole process with so many cycles, and those within each step.
fn allocations(cycles: u64) -> (u64, Vec<u64>) {
    let table = "[[process]]\nname = \"world\"\nprogram = \"none\"\norder = 1\ntrigger = \"timer\"\n";
    let run = TestRun::new(table);
    let process = Process::open("world", run.0.directory(), 0).unwrap();
    run.0.start(coact_realtime::now()).unwrap();
    let mut counts = Vec::with_capacity(cycles as usize);
    let cycle = Counted {
        command: process.bus().input(topic::COMMAND).unwrap(),
        sample: process.bus().output(topic::SENSORS).unwrap(),
        cycles: cycles as usize,
        counts: &mut counts,
    };
    let total = measure(|| process.run_cycles(cycle).unwrap()).count_total;
    (total, counts)
}

#[test]
fn steady_cycle_allocates_once_for_each_loan() {
    let (shorter, _) = allocations(WARM_UP);
    let (longer, steps) = allocations(WARM_UP + CYCLES);
    assert_eq!(longer - shorter, LOANS * CYCLES);
    assert_eq!(steps[WARM_UP as usize..], [1; CYCLES as usize]);
}

#[test]
fn reading_allocates_nothing() {
    let run = TestRun::new(support::TABLE);
    let bus = coact_realtime::Bus::open(&run.0, "fields", 0).unwrap();
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
