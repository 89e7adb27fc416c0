//! A process that may open nothing any more says so, instead of going on without those that are new. One test, for the limit is the
//! whole process's.
#![allow(clippy::unwrap_used)]

mod support;

use coact_messages::{Percept, topic};
use coact_realtime::{Bus, Input, PortError};
use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
use support::TestRun;

#[test]
fn a_writer_that_cannot_connect_a_new_reader_fails_and_the_next_one_serves_it() {
    let run = TestRun::started();
    let bus = Bus::open(&run.0, "perception", 0).unwrap();
    let mut output = bus.output::<Percept>(topic::PERCEPT).unwrap();
    output.loan().unwrap().send(1, 42).unwrap();
    let mut input: Input<Percept> = bus.input(topic::PERCEPT).unwrap();
    let before = getrlimit(Resource::Nofile);
    setrlimit(Resource::Nofile, Rlimit { current: Some(0), ..before }).unwrap();
    let failed = output.loan().unwrap().send(2, 42);
    setrlimit(Resource::Nofile, before).unwrap();
    assert!(matches!(failed, Err(PortError::NoHandles { .. })), "{failed:?}");
    drop(output);
    let mut next = bus.output::<Percept>(topic::PERCEPT).unwrap();
    next.loan().unwrap().send(3, 42).unwrap();
    assert!(input.refresh().unwrap());
    assert_eq!(input.header().unwrap().cycle, 3);
}
