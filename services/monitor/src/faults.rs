use coact_messages::Pulse;
use coact_period::PERIOD_NS;
use coact_realtime::LateWakeUp;
use coact_run_records::{Event, FaultEvent, SupervisorEvent, SupervisorEventKind};
use std::collections::{BTreeMap, VecDeque};
use std::time::Duration;

/// How long after a recovery the fault is written down, ns. By then the pulses of all processes have been read, which
/// happens every few milliseconds, even if the monitor itself was held up.
const SETTLING_NS: u64 = Duration::from_millis(200).as_nanos() as u64;
/// For how long outages are remembered, ns. No recovery takes longer: a process that is not ready again within that time
/// has been given up.
const REMEMBERED_NS: u64 = Duration::from_secs(120).as_nanos() as u64;

/// So many timely outputs of each process are remembered: those of a second, more than lie between a fault and the record of
/// it in the supervisor's log.
const GOOD_OUTPUTS: usize = 1024;

/// Finds for each fault who failed, since when, when that was noticed, when it was over, and what it cost the others.
///
/// A fault begins with the last good output before it, whoever noticed it when. A process that died has recovered with the
/// first timely output of its replacement. One that was only disturbed (stopped for a while, slowed down) has recovered with
/// its first timely output after the last late one. A process that sends no pulses has failed when the fault was injected or
/// seen, and has recovered when its replacement reported ready.
#[derive(Debug)]
pub struct Faults {
    /// Processes that send pulses.
    pulsing: Vec<String>,
    open: Vec<OpenFault>,
    /// Newest timely outputs of each process: generation and publication.
    good: BTreeMap<String, VecDeque<(u32, u64)>>,
    /// Outages of the last two minutes: release of the cycle at their end, process, how many cycles without output.
    outages: VecDeque<(u64, String, u64)>,
    /// When the machine was late in the last two minutes.
    machine_late: VecDeque<LateWakeUp>,
    /// Up to which instant each process's faults are in the report already.
    settled: BTreeMap<String, u64>,
}

#[derive(Debug)]
struct OpenFault {
    process: String,
    fault: String,
    /// When it was injected, or seen.
    reported_ns: u64,
    /// The last good output before it, where one was seen.
    last_good_ns: Option<u64>,
    /// The process that failed, and its newest dead replacement.
    first_generation: u32,
    generation: u32,
    /// An output was late or missing since then.
    disturbed: bool,
    detected_ns: Option<u64>,
    recovered_ns: Option<u64>,
    given_up: bool,
}

impl Faults {
    /// `pulsing`: names of the processes that send pulses.
    pub fn new(pulsing: Vec<String>) -> Self {
        Self {
            pulsing,
            open: Vec::new(),
            good: BTreeMap::new(),
            outages: VecDeque::new(),
            machine_late: VecDeque::new(),
            settled: BTreeMap::new(),
        }
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
        let last_good_ns = self.last_good(event);
        let open = self.open.iter_mut().find(|open| open.process == event.process && !open.is_over());
        match (kind, open) {
            (SupervisorEventKind::Injected, None) => self.begin(event, cause, last_good_ns, None),
            (SupervisorEventKind::Died, None) => self.begin(event, cause, last_good_ns, Some(event.at_ns)),
            (SupervisorEventKind::Died, Some(open)) => open.died(event, last_good_ns),
            (SupervisorEventKind::GaveUp, Some(open)) => open.given_up = true,
            (SupervisorEventKind::Ready, Some(open)) if !pulsing && event.generation > open.generation => {
                open.recovered_ns = Some(event.at_ns);
            }
            _ => {}
        }
    }

    /// One cycle of a process, and how many up to it, since the one before, had no timely output.
    pub fn pulse(&mut self, process: &str, pulse: &Pulse, outage: u64) {
        if outage > 0 {
            self.outages.push_back((pulse.released_ns, process.to_owned(), outage));
        }
        let timely = pulse.header.published_ns <= pulse.released_ns + PERIOD_NS;
        for open in self.open.iter_mut().filter(|open| open.process == process) {
            open.pulse(pulse, timely, outage);
        }
        if timely {
            self.remember(process, pulse);
        }
    }

    /// The machine itself was late, whatever process failed.
    pub fn machine_late(&mut self, late: LateWakeUp) {
        self.machine_late.push_back(late);
    }

    fn remember(&mut self, process: &str, pulse: &Pulse) {
        if !self.good.contains_key(process) {
            self.good.insert(process.to_owned(), VecDeque::with_capacity(GOOD_OUTPUTS));
        }
        let Some(good) = self.good.get_mut(process) else { return };
        if good.len() == GOOD_OUTPUTS {
            good.pop_front();
        }
        good.push_back((pulse.header.generation, pulse.header.published_ns));
    }

    /// The last good output, before the event, of the process that the event is about.
    fn last_good(&self, event: &SupervisorEvent) -> Option<u64> {
        let before = |(generation, at): &(u32, u64)| {
            (*generation <= event.generation && *at <= event.at_ns).then_some(*at)
        };
        self.good.get(&event.process)?.iter().rev().find_map(before)
    }

    /// Appends to `events` the faults that are over, once all pulses from that time have come.
    pub fn settle(&mut self, now_ns: u64, events: &mut Vec<Event>) {
        self.outages.retain(|&(at, ..)| now_ns.saturating_sub(at) < REMEMBERED_NS);
        self.machine_late.retain(|late| now_ns.saturating_sub(late.woken_ns) < REMEMBERED_NS);
        let over = |open: &OpenFault| {
            open.given_up || open.recovered_ns.is_some_and(|at| now_ns > at.saturating_add(SETTLING_NS))
        };
        for open in self.open.extract_if(.., |open| over(open)) {
            events.push(describe(&open, &self.outages, &self.machine_late));
        }
    }

    /// Ends the run: faults that are not over stay so.
    pub fn finish(&mut self, events: &mut Vec<Event>) {
        for open in self.open.drain(..) {
            events.push(describe(&open, &self.outages, &self.machine_late));
        }
    }

    fn begin(
        &mut self,
        event: &SupervisorEvent,
        cause: Option<&String>,
        last_good_ns: Option<u64>,
        detected_ns: Option<u64>,
    ) {
        self.open.push(OpenFault {
            process: event.process.clone(),
            fault: cause.cloned().unwrap_or_else(|| "died".into()),
            reported_ns: event.at_ns,
            last_good_ns,
            first_generation: event.generation,
            generation: event.generation,
            disturbed: false,
            detected_ns,
            recovered_ns: None,
            given_up: false,
        });
    }
}

impl OpenFault {
    /// A replacement that died as well belongs to the same fault.
    fn died(&mut self, event: &SupervisorEvent, last_good_ns: Option<u64>) {
        if self.detected_ns.is_none() && !self.disturbed {
            self.last_good_ns = last_good_ns.or(self.last_good_ns);
        }
        self.detected_ns = self.detected_ns.or(Some(event.at_ns));
        self.generation = event.generation;
        self.recovered_ns = None;
    }

    fn pulse(&mut self, pulse: &Pulse, timely: bool, outage: u64) {
        let (published, generation) = (pulse.header.published_ns, pulse.header.generation);
        if generation > self.generation {
            self.recovered_ns = self.recovered_ns.or(timely.then_some(published));
        } else if self.detected_ns.is_none() && published > self.reported_ns {
            self.survived_until(published, timely, outage);
        } else if generation == self.first_generation && timely && !self.disturbed {
            // Published before the fault, and read only now.
            self.last_good_ns = self.last_good_ns.max(Some(published));
        }
    }

    /// An output of the process itself after the fault was injected.
    fn survived_until(&mut self, published: u64, timely: bool, outage: u64) {
        self.disturbed |= outage > 0;
        if !self.disturbed {
            // It goes on for some cycles before the fault takes effect, or is never disturbed.
            self.last_good_ns = Some(published);
        }
        let since = if outage > 0 { None } else { self.recovered_ns };
        self.recovered_ns = since.or(timely.then_some(published));
    }

    /// A later event of the process is no part of this fault.
    fn is_over(&self) -> bool {
        self.given_up || (self.detected_ns.is_some() && self.recovered_ns.is_some())
    }
}

fn describe(
    open: &OpenFault,
    outages: &VecDeque<(u64, String, u64)>,
    machine_late: &VecDeque<LateWakeUp>,
) -> Event {
    let at_ns = open.last_good_ns.unwrap_or(open.reported_ns);
    let until = open.recovered_ns.unwrap_or(u64::MAX);
    let mut survivors_missed = BTreeMap::new();
    for (at, process, missed) in outages {
        if *process != open.process && (at_ns..=until).contains(at) {
            *survivors_missed.entry(process.clone()).or_default() += missed;
        }
    }
    let meanwhile = machine_late.iter().filter(|late| late.due_ns <= until && late.woken_ns >= at_ns);
    let machine_late_ns = meanwhile.map(|late| late.woken_ns - late.due_ns).max().unwrap_or(0);
    let after_ms = |instant: u64| instant.saturating_sub(at_ns) as f64 / 1e6;
    Event::Fault(FaultEvent {
        process: open.process.clone(),
        fault: open.fault.clone(),
        at_ns,
        detected_ms: open.detected_ns.map(after_ms),
        recovered_ms: open.recovered_ns.map(after_ms),
        survivors_missed,
        machine_late_ms: machine_late_ns as f64 / 1e6,
    })
}
