//! A steady cycle allocates what iceoryx2 does for each loan, and nothing else.
//!
//! This is the pattern for a stage alone, too: a counting allocator in a test program of its own, some cycles to
//! warm up, then `allocations()` before and after `stage.step(..)`, whose difference must be zero.
#![allow(clippy::unwrap_used)]

mod support;

use coact_messages::{Command, Header, SensorSample, topic};
use coact_realtime::{Cycle, Input, Output, PortError, Process, Tick};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use support::TestRun;

/// Counts the allocations of each thread by itself: the test harness has threads of its own.
struct Counting;

thread_local! {
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

fn allocations() -> usize {
    COUNT.get()
}

// SAFETY: every call goes to the system's allocator unchanged; counting touches no memory of theirs.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        // SAFETY: the caller keeps the promises of `GlobalAlloc::alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        // SAFETY: the caller keeps the promises of `GlobalAlloc::realloc`.
        unsafe { System.realloc(block, layout, size) }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the promises of `GlobalAlloc::dealloc`.
        unsafe { System.dealloc(block, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Cycles in which connections are made and buffers reach their size.
const WARM_UP: usize = 20;
const CYCLES: usize = 200;
/// The cycle's own output, and its pulse.
const LOANS: usize = 2;

/// A trivial stage that counts the allocations from the start of one cycle to the start of the next.
struct Counted<'a> {
    command: Input<Command>,
    sample: Output<SensorSample>,
    before: Option<usize>,
    counts: &'a mut Vec<usize>,
}

impl Cycle for Counted<'_> {
    type Trigger = Command;

    fn trigger(&mut self) -> &mut Input<Command> {
        &mut self.command
    }

    fn step(&mut self, tick: Tick) -> Result<Header, PortError> {
        let now = allocations();
        if let Some(before) = self.before.replace(now) {
            self.counts.push(now - before);
        }
        if self.counts.len() == WARM_UP + CYCLES {
            // SAFETY: sends this process the signal that the executor handles as a request to stop.
            unsafe { libc::raise(libc::SIGTERM) };
        }
        let mut sample = self.sample.loan()?;
        sample.joints.touch = tick.cycle as f64;
        sample.send(tick.cycle, tick.started_ns)
    }
}

#[test]
fn steady_cycle_allocates_once_for_each_loan() {
    let table = "[[process]]\nname = \"world\"\nprogram = \"none\"\norder = 1\ntrigger = \"timer\"\n";
    let run = TestRun::new(table);
    let process = Process::open("world", run.0.directory(), 0).unwrap();
    run.0.start(coact_realtime::now()).unwrap();
    let mut counts = Vec::with_capacity(WARM_UP + CYCLES + 1);
    let cycle = Counted {
        command: process.bus().input(topic::COMMAND).unwrap(),
        sample: process.bus().output(topic::SENSORS).unwrap(),
        before: None,
        counts: &mut counts,
    };
    process.run_cycles(cycle).unwrap();
    assert_eq!(counts.len(), WARM_UP + CYCLES);
    assert_eq!(counts[WARM_UP..], [LOANS; CYCLES]);
}

#[test]
fn reading_allocates_nothing() {
    let run = TestRun::new(support::TABLE);
    let bus = coact_realtime::Bus::open(&run.0, "fields", 0).unwrap();
    let mut input: Input<SensorSample> = bus.trigger(topic::SENSORS).unwrap();
    let mut output: Output<SensorSample> = bus.output(topic::SENSORS).unwrap();
    for cycle in 1..=(WARM_UP + CYCLES) as u64 {
        output.loan().unwrap().send(cycle, 0).unwrap();
        let before = allocations();
        assert!(input.wait_for(cycle, u64::MAX).unwrap());
        if cycle > WARM_UP as u64 {
            assert_eq!(allocations() - before, 0, "in cycle {cycle}");
        }
    }
}
