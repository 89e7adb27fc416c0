use crate::CycleMisses;
use coact_messages::Pulse;
use coact_run_records::{Event, FaultEvent, SupervisorEvent, SupervisorEventKind};
use std::collections::{BTreeMap, VecDeque};
use std::time::Duration;

/// How long after a recovery the fault is written down, ns. By then the pulses of all processes have been read, which
/// happens every few milliseconds, even if the monitor itself was held up.
const SETTLING_NS: u64 = Duration::from_millis(200).as_nanos() as u64;
/// For how long misses are remembered, ns. No recovery takes longer: a process that is not ready again within that time
/// has been given up.
const REMEMBERED_NS: u64 = Duration::from_secs(120).as_nanos() as u64;

/// Finds for each fault who failed, when that was noticed, when it was over, and what it cost the others.
///
/// A process that died has recovered with the first output of its replacement. One that was only disturbed
/// (stopped for a while, slowed down) has recovered with its first timely cycle after the last late one. A
/// process that sends no pulses has recovered when its replacement reported ready.
#[derive(Debug)]
pub struct Faults {
    /// Processes that send pulses.
    pulsing: Vec<String>,
    open: Vec<OpenFault>,
    /// Deadline misses of the last two minutes: release of the cycle, process, how many.
    misses: VecDeque<(u64, String, u64)>,
    /// Up to which instant each process's faults are in the report already.
    settled: BTreeMap<String, u64>,
}

#[derive(Debug)]
struct OpenFault {
    process: String,
    fault: String,
    at_ns: u64,
    generation: u32,
    detected_ns: Option<u64>,
    recovered_ns: Option<u64>,
    given_up: bool,
}

impl Faults {
    /// `pulsing`: names of the processes that send pulses.
    pub fn new(pulsing: Vec<String>) -> Self {
        Self { pulsing, open: Vec::new(), misses: VecDeque::new(), settled: BTreeMap::new() }
    }

    /// Goes on after a restart: these faults are in the report already.
    pub fn resume(&mut self, events: &[Event]) {
        for event in events {
            if let Event::Fault(fault) = event {
                let settled = self.settled.entry(fault.process.clone()).or_default();
                *settled = fault.settled_ns().max(*settled);
            }
        }
    }

    /// What the supervisor saw or did.
    pub fn supervisor(&mut self, event: &SupervisorEvent) {
        if self.settled.get(&event.process).is_some_and(|&settled| event.at_ns <= settled) {
            return;
        }
        let (kind, cause) = (event.event, event.fault.as_ref().or(event.reason.as_ref()));
        let pulsing = self.pulsing.contains(&event.process);
        let open = self.open.iter_mut().find(|open| open.process == event.process && !open.is_over());
        match (kind, open) {
            (SupervisorEventKind::Injected, None) => self.begin(event, cause, None),
            (SupervisorEventKind::Died, None) => self.begin(event, cause, Some(event.at_ns)),
            (SupervisorEventKind::Died, Some(open)) => open.died(event),
            (SupervisorEventKind::GaveUp, Some(open)) => open.given_up = true,
            (SupervisorEventKind::Ready, Some(open)) if !pulsing && event.generation > open.generation => {
                open.recovered_ns = Some(event.at_ns);
            }
            _ => {}
        }
    }

    /// One cycle of a process, and what it missed.
    pub fn pulse(&mut self, process: &str, pulse: &Pulse, missed: CycleMisses) {
        if missed.missed > 0 {
            self.misses.push_back((pulse.released_ns, process.to_owned(), missed.missed));
        }
        for open in self.open.iter_mut().filter(|open| open.process == process) {
            open.pulse(pulse, missed);
        }
    }

    /// Appends to `events` the faults that are over, once all pulses from that time have come.
    pub fn settle(&mut self, now_ns: u64, events: &mut Vec<Event>) {
        self.misses.retain(|&(at, ..)| now_ns.saturating_sub(at) < REMEMBERED_NS);
        let over = |open: &OpenFault| {
            open.given_up || open.recovered_ns.is_some_and(|at| now_ns > at.saturating_add(SETTLING_NS))
        };
        for open in self.open.extract_if(.., |open| over(open)) {
            events.push(describe(&open, &self.misses));
        }
    }

    /// Ends the run: faults that are not over stay so.
    pub fn finish(&mut self, events: &mut Vec<Event>) {
        for open in self.open.drain(..) {
            events.push(describe(&open, &self.misses));
        }
    }

    fn begin(&mut self, event: &SupervisorEvent, cause: Option<&String>, detected_ns: Option<u64>) {
        self.open.push(OpenFault {
            process: event.process.clone(),
            fault: cause.cloned().unwrap_or_else(|| "died".into()),
            at_ns: event.at_ns,
            generation: event.generation,
            detected_ns,
            recovered_ns: None,
            given_up: false,
        });
    }
}

impl OpenFault {
    /// A replacement that died as well belongs to the same fault.
    fn died(&mut self, event: &SupervisorEvent) {
        self.detected_ns = self.detected_ns.or(Some(event.at_ns));
        self.generation = event.generation;
        self.recovered_ns = None;
    }

    fn pulse(&mut self, pulse: &Pulse, missed: CycleMisses) {
        let published = pulse.header.published_ns;
        let replaced = pulse.header.generation > self.generation;
        if published <= self.at_ns || (self.detected_ns.is_some() && !replaced) {
            return;
        }
        let disturbed = !replaced && (missed.missed > 0 || missed.skipped > 0);
        self.recovered_ns = if disturbed { None } else { self.recovered_ns.or(Some(published)) };
    }

    /// A later event of the process is no part of this fault.
    fn is_over(&self) -> bool {
        self.given_up || (self.detected_ns.is_some() && self.recovered_ns.is_some())
    }
}

fn describe(open: &OpenFault, misses: &VecDeque<(u64, String, u64)>) -> Event {
    let until = open.recovered_ns.unwrap_or(u64::MAX);
    let mut survivors_missed = BTreeMap::new();
    for (at, process, missed) in misses {
        if *process != open.process && (open.at_ns..=until).contains(at) {
            *survivors_missed.entry(process.clone()).or_default() += missed;
        }
    }
    let after_ms = |instant: u64| instant.saturating_sub(open.at_ns) as f64 / 1e6;
    Event::Fault(FaultEvent {
        process: open.process.clone(),
        fault: open.fault.clone(),
        at_ns: open.at_ns,
        detected_ms: open.detected_ns.map(after_ms),
        recovered_ms: open.recovered_ns.map(after_ms),
        survivors_missed,
    })
}
