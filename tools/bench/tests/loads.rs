//! Loads: made where stress-ng is, refused in clear words where it is not, and over when they are dropped.
#![allow(clippy::unwrap_used)]

use coact_bench::{BenchError, Load, RunningLoad};
use std::time::{Duration, Instant};

#[test]
fn a_load_ends_when_it_is_dropped_or_its_lack_is_said() {
    assert!(RunningLoad::start(Load::None, Duration::from_secs(1)).unwrap().is_none());
    let begin = Instant::now();
    match RunningLoad::start(Load::Io, Duration::from_secs(60)) {
        Ok(load) => drop(load.unwrap()),
        Err(error @ BenchError::NoStress(_)) => {
            assert!(error.to_string().contains("--load io needs stress-ng"), "{error}");
        }
        Err(other) => panic!("{other}"),
    }
    assert!(begin.elapsed() < Duration::from_secs(20), "it lasted on for {:?}", begin.elapsed());
}

#[test]
fn loads_are_known_by_their_names() {
    for load in Load::ALL {
        assert_eq!(load.name().parse(), Ok(load));
    }
    assert_eq!("disk".parse::<Load>(), Err("expected one of none, cpu, memory, io, all".to_owned()));
}
