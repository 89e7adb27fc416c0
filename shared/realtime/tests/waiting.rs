//! A process that may have no file handles cannot be told of a message by the kernel. It looks for it, and leaves the core to others meanwhile. One
//! test, for the limit is the whole process's.
#![allow(clippy::unwrap_used)]

mod support;

use coact_messages::{Percept, topic};
use coact_realtime::{Bus, Input, now};
use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
use rustix::time::{ClockId, clock_gettime};
use std::time::Duration;
use support::TestRun;

const WAITED: Duration = Duration::from_millis(15);

fn computed() -> Duration {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    Duration::new(time.tv_sec as u64, time.tv_nsec as u32)
}

#[test]
fn a_reader_without_handles_waits_without_computing_and_still_hears() {
    let run = TestRun::started();
    let bus = Bus::open(&run.0, "perception", 0).unwrap();
    let mut output = bus.output::<Percept>(topic::PERCEPT).unwrap();
    let mut input: Input<Percept> = bus.trigger(topic::PERCEPT).unwrap();
    output.loan().unwrap().send(1, 42).unwrap();
    assert!(input.wait_for(1, now()).unwrap());
    let before = getrlimit(Resource::Nofile);
    setrlimit(Resource::Nofile, Rlimit { current: Some(0), ..before }).unwrap();
    let (computed_before, until) = (computed(), now() + WAITED.as_nanos() as u64);
    let heard = input.wait_for(2, until).unwrap();
    let (ended, used) = (now(), computed() - computed_before);
    output.loan().unwrap().send(2, 42).unwrap();
    let hears = input.wait_for(2, now() + WAITED.as_nanos() as u64).unwrap();
    setrlimit(Resource::Nofile, before).unwrap();
    assert!(!heard && ended >= until, "nothing was sent");
    assert!(used < WAITED / 2, "{used:?} of {WAITED:?} computed");
    assert!(hears);
}
