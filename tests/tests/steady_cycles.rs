//! A steady cycle takes no page fault and makes only the system calls that it needs: seen by a debugger, on a real set.
#![allow(clippy::unwrap_used)]

use coact_messages::{Pulse, topic};
use coact_pipeline::{Pipeline, Run};
use coact_realtime::{Bus, Input, exclude_real_time_cores};
use coact_table_edit::TableEdit;
use coact_tests::{Launched, ThreadFaults, TraceError, Tracer, checkout};
use rustix::process::Signal;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A process of the chain, and how often each of its cycles may make a system call.
struct Expected {
    process: &'static str,
    /// Name, and the least and the most in each cycle.
    calls: &'static [(&'static str, f64, f64)],
}

/// The sleep until the next release, and the socket by which the next stage hears of a message: once in each cycle. A stage that
/// waits for a topic hears of a message once more that it has taken in already, when its writer was late and it looked by itself:
/// one cycle in thirty, where the debugger delays them. Control wakes its planner. A stage whose cycle lasted longer than the period
/// asks how much of that it has computed itself: only the debugger makes many of them last so long. The least shows that calls are
/// seen at all: a debugger that has to share its core misses some.
const ONCE: (f64, f64) = (0.5, 1.0);
const WAIT: (f64, f64) = (0.5, 1.5);
const OVERRUN: (&str, f64, f64) = ("clock_gettime", 0.0, 1.0);
const EXPECTED: [Expected; 4] = [
    Expected {
        process: "world",
        calls: &[("clock_nanosleep", ONCE.0, ONCE.1), ("sendto", ONCE.0, ONCE.1), OVERRUN],
    },
    Expected {
        process: "perception",
        calls: &[
            ("ppoll", WAIT.0, WAIT.1),
            ("recvfrom", WAIT.0, WAIT.1),
            ("sendto", ONCE.0, ONCE.1),
            OVERRUN,
        ],
    },
    Expected {
        process: "fields",
        calls: &[
            ("ppoll", WAIT.0, WAIT.1),
            ("recvfrom", WAIT.0, WAIT.1),
            ("sendto", ONCE.0, ONCE.1),
            OVERRUN,
        ],
    },
    Expected {
        process: "control",
        calls: &[("ppoll", WAIT.0, WAIT.1), ("recvfrom", WAIT.0, WAIT.1), ("futex", 0.0, 1.0), OVERRUN],
    },
];

/// Fewer cycles than these tell nothing.
const FEWEST_CYCLES: u64 = 200;
/// Cycles in which calls are counted and which the pulses before and after do not.
const AT_THE_ENDS: f64 = 2.0;
/// When a reader is late, its writer takes a slot in which no message lay yet, and both touch it for the first time.
const FIRST_TOUCHES: u64 = 4;
/// Loading a program takes far more page faults than this: so it is known that they are counted.
const LOADING: u64 = 100;

/// Until then the set has become steady: connections are made, every buffer was used. Chosen by hand.
const WARM_UP: Duration = Duration::from_secs(5);
/// How long page faults are counted, and how long each process is traced at a time: some thousand and some hundred cycles.
const COUNTED: Duration = Duration::from_secs(4);
const TRACED: Duration = Duration::from_secs(2);
/// A machine on which the debugger delays a process so much that it makes too few cycles traces it up to so many times.
const TIMES: usize = 4;
/// The set ends by itself after this, whatever becomes of the test, s.
const LONGEST: &str = "60";
/// The set's start and end take no longer, or the test fails.
const STARTS_WITHIN: Duration = Duration::from_secs(25);
const ENDS_WITHIN: Duration = Duration::from_secs(15);

/// The process table, with a watchdog that waits for what a debugger slows down, in a folder of its own.
fn patient_table(folder: &Path) -> PathBuf {
    let table = TableEdit::of(&checkout().join("rt-config")).unwrap();
    table.with("restart", "hung_after_ms", 10_000).unwrap().write(folder).unwrap()
}

/// How many messages a process has sent.
fn sent(pulses: &mut Input<Pulse>) -> u64 {
    pulses.refresh().unwrap();
    pulses.header().unwrap().sequence
}

/// What one process did while it was watched.
#[derive(Debug)]
struct Seen {
    process: &'static str,
    cycles: u64,
    calls: BTreeMap<&'static str, u64>,
}

/// The processes of the chain in a set that lives as long as it is looked at.
struct Chain {
    pids: [u32; 4],
    pulses: [Input<Pulse>; 4],
    _bus: Bus,
}

impl Chain {
    fn of(run: &Run) -> Self {
        let bus = Bus::open(run, "steady-cycles", 0).unwrap();
        let ready = EXPECTED.map(|expected| run.ready(expected.process, 0).unwrap().unwrap());
        for ready in ready.iter().filter(|ready| !ready.memory_locked) {
            eprintln!("{}: its memory is not locked; page faults of it are no fault of ours", ready.process);
        }
        let pulses = EXPECTED.map(|expected| bus.input::<Pulse>(&topic::pulse(expected.process)).unwrap());
        Self { pids: ready.map(|ready| ready.pid), pulses, _bus: bus }
    }

    /// Page faults of each process, and how many cycles it made meanwhile.
    fn faults(&mut self) -> [(ThreadFaults, u64); 4] {
        let look = |chain: &mut Self| {
            let faults = chain.pids.map(|pid| ThreadFaults::of(pid).expect("the set lives"));
            (faults, chain.pulses.each_mut().map(sent))
        };
        let (faults, cycles) = look(self);
        assert!(faults.iter().all(|faults| faults.minor > LOADING), "{faults:?}");
        std::thread::sleep(COUNTED);
        let (now, then) = look(self);
        std::array::from_fn(|index| (now[index].since(faults[index]), then[index] - cycles[index]))
    }

    /// The system calls of a process.
    fn calls(&mut self, index: usize) -> Result<Seen, TraceError> {
        let mut tracer = Tracer::attach(self.pids[index])?;
        let before = sent(&mut self.pulses[index]);
        let mut seen = Seen { process: EXPECTED[index].process, cycles: 0, calls: BTreeMap::new() };
        for _ in 0..TIMES {
            tracer.calls(TRACED)?.iter().for_each(|call| *seen.calls.entry(call.name()).or_default() += 1);
            seen.cycles = sent(&mut self.pulses[index]) - before;
            if seen.cycles >= FEWEST_CYCLES {
                break;
            }
        }
        Ok(seen)
    }
}

#[test]
fn steady_cycles_take_no_page_fault_and_make_no_other_system_call_than_they_need() {
    let folder = tempfile::tempdir().unwrap();
    let table = patient_table(folder.path());
    let path = table.to_str().unwrap();
    let mut launched = Launched::start(&["--world", "kinematic", "--duration", LONGEST, "--pipeline", path]);
    let run = launched.when_started_within(STARTS_WITHIN);
    let ready = EXPECTED.map(|expected| run.ready(expected.process, 0).unwrap().unwrap());
    exclude_real_time_cores(&Pipeline::load(&table).unwrap());
    std::thread::sleep(WARM_UP);
    let mut chain = Chain::of(&run);
    std::thread::sleep(Duration::from_millis(500));
    let faults = chain.faults();
    let seen: Result<Vec<Seen>, TraceError> = (0..EXPECTED.len()).map(|index| chain.calls(index)).collect();
    // Nothing of a process is looked at from here on.
    drop(chain);
    launched.signal(Signal::TERM);
    launched.finish_within(ENDS_WITHIN);
    for (ready, (faults, cycles)) in ready.iter().zip(faults).filter(|(ready, _)| ready.memory_locked) {
        let is_none = faults.major == 0 && faults.minor <= FIRST_TOUCHES;
        assert!(is_none && cycles >= FEWEST_CYCLES, "{}: {faults:?} in {cycles} cycles", ready.process);
    }
    match seen {
        Ok(seen) => seen.iter().zip(&EXPECTED).for_each(|(seen, expected)| judge(seen, expected)),
        Err(TraceError::NotPermitted) => {
            eprintln!("system calls were not counted: this machine does not permit tracing")
        }
        Err(error) => panic!("{error}"),
    }
}

/// Each expected call as often as expected, and no other one.
fn judge(seen: &Seen, expected: &Expected) {
    assert!(seen.cycles >= FEWEST_CYCLES, "{seen:?}");
    let cycles = seen.cycles as f64;
    for (name, least, most) in expected.calls {
        let count = seen.calls.get(name).copied().unwrap_or_default() as f64;
        let range = least * cycles - AT_THE_ENDS..=most * cycles + AT_THE_ENDS;
        assert!(
            range.contains(&count),
            "{}: {name} {count} times, expected {range:?}: {seen:?}",
            seen.process
        );
    }
    for name in seen.calls.keys() {
        assert!(expected.calls.iter().any(|(known, ..)| known == name), "{name} is unexpected: {seen:?}");
    }
}
