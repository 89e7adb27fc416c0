use crate::cycle_accounting::{CycleAccounting, CycleTimes, misses_deadline};
use crate::monotonic_clock::{now, thread_time, timespec};
use crate::overload::Overload;
use crate::signals::Signals;
use crate::{Cycle, Output, PortError, ProcessError, Refusals, Schedule, Tick};
use coact_messages::{Header, Pulse};
use coact_pipeline::{ProcessEntry, Trigger};
use rustix::thread::clock_nanosleep_absolute;
use rustix::time::ClockId;
use std::sync::Arc;
use std::time::Duration;

/// An injected slowness lasts so many cycles. Chosen by hand: long enough to be seen in the report, and its pulses come every
/// 6 ms at the slowest, often enough that the watchdog does not take the process for hung.
const SLOWED_CYCLES: u32 = 50;

/// While not even the input of the cycle before has come, a stage starts by so much sooner than it would at the latest: whoever sends it is
/// dead or hangs, and is not waited for; the time is kept for the deadline. Chosen by hand.
const SOONER_NS: u64 = 200_000;

/// A stage that may not end yet goes on for so many cycles at most: arms stop within half a second.
const LONGEST_END: u64 = coact_period::CYCLES_PER_SECOND;

/// Runs a [`Cycle`] once in each period: wait, step, count, publish the pulse.
pub(crate) struct Executor {
    schedule: Schedule,
    /// Offset from the release up to which a cycle waits for its input; `None`: it starts at the release.
    latest_start_ns: Option<u64>,
    accounting: CycleAccounting,
    overload: Overload,
    pulse: Output<Pulse>,
    refusals: Arc<Refusals>,
    slowed_cycles: u32,
    /// By how much each of them takes longer.
    slowdown: Duration,
}

/// Whether the process starts its cycles by the messages of `topic`, or by the timer.
pub(crate) fn waits_for_topic(entry: &ProcessEntry, topic: &str) -> Result<bool, ProcessError> {
    let found = match &entry.trigger {
        Trigger::Timer => return Ok(false),
        Trigger::Topic(found) if found == topic => return Ok(true),
        Trigger::Topic(found) => format!("\"{found}\""),
        Trigger::None => "absent".to_owned(),
    };
    Err(ProcessError::Trigger { process: entry.name.clone(), found, expected: topic.to_owned() })
}

impl Executor {
    pub(crate) fn new(
        entry: &ProcessEntry,
        schedule: Schedule,
        waits_for_topic: bool,
        pulse: Output<Pulse>,
        refusals: Arc<Refusals>,
    ) -> Self {
        Self {
            schedule,
            latest_start_ns: waits_for_topic.then_some(entry.latest_start.as_nanos() as u64),
            accounting: CycleAccounting::default(),
            overload: Overload::default(),
            pulse,
            refusals,
            slowed_cycles: 0,
            slowdown: Duration::ZERO,
        }
    }

    /// Runs until a signal stops it and the stage may end.
    ///
    /// # Errors
    /// A port that failed; [`ProcessError::Overload`] when the stage, which was fast enough, is too slow for the others.
    pub(crate) fn run(&mut self, work: &mut impl Cycle, signals: &Signals) -> Result<(), ProcessError> {
        let mut cycle = self.schedule.next_after(now());
        let mut in_time = true;
        let mut last = None;
        loop {
            let mut scheduled_ns = self.wait(cycle, work, signals)?;
            if signals.stop() {
                let last = *last.get_or_insert(cycle + LONGEST_END);
                if work.may_end() || cycle >= last {
                    return Ok(());
                }
                // The request has ended the wait early.
                scheduled_ns = self.wait(cycle, work, signals)?;
            }
            if let Some(slowdown) = signals.take_slowdown() {
                (self.slowed_cycles, self.slowdown) = (SLOWED_CYCLES, slowdown);
            }
            let started_ns = now();
            self.run_cycle(cycle, scheduled_ns, work)?;
            if self.overload.is_reached(now() - started_ns, thread_time) {
                return Err(ProcessError::Overload);
            }
            let ended_ns = now();
            cycle = self.schedule.following(cycle, ended_ns, in_time);
            in_time = ended_ns <= self.schedule.release(cycle);
        }
    }

    /// Waits for the start of `cycle`; returns when it was due. A request to stop ends the wait early.
    fn wait(&self, cycle: u64, work: &mut impl Cycle, signals: &Signals) -> Result<u64, PortError> {
        let release = self.schedule.release(cycle);
        let trigger = work.trigger();
        let Some(latest_start) = self.latest_start_ns else {
            let sleep = || clock_nanosleep_absolute(ClockId::Monotonic, &timespec(release));
            let was_told = signals.stop();
            while sleep().is_err() && signals.stop() == was_told {}
            trigger.refresh()?;
            return Ok(release);
        };
        let mut latest = release + latest_start.saturating_sub(SOONER_NS);
        let mut came = trigger.wait_for(cycle, latest)?;
        if !came && trigger.header().is_some_and(|header| header.cycle + 1 >= cycle) {
            // Its sender may only be late: the input of the cycle before has come, however late.
            latest = release + latest_start;
            came = trigger.wait_for(cycle, latest)?;
        }
        let woken = now();
        if !came && misses_deadline(release, woken) {
            // This stage woke up after its deadline, so the stages before it did too, and may not have had the core yet.
            // It gives them the time that they always have, and then works on a new sample instead of an old one.
            came = trigger.wait_for(cycle, woken + latest_start)?;
        }
        let published = trigger.header().map_or(0, |header| header.published_ns);
        Ok(if came { published.max(release) } else { latest })
    }

    fn run_cycle(&mut self, cycle: u64, scheduled_ns: u64, work: &mut impl Cycle) -> Result<(), PortError> {
        let started_ns = now();
        let released_ns = self.schedule.release(cycle);
        let input = work.trigger().header().copied();
        let received_ns = work.trigger().received_ns();
        self.inject_slowness(started_ns);
        let output = work.step(Tick { cycle, released_ns, started_ns })?;
        let times = CycleTimes { released_ns, scheduled_ns, started_ns, received_ns };
        self.publish_pulse(times, input.as_ref(), output)
    }

    fn publish_pulse(
        &mut self,
        times: CycleTimes,
        input: Option<&Header>,
        output: Header,
    ) -> Result<(), PortError> {
        let Self { accounting, refusals, .. } = self;
        let (refused, refused_topic) = (refusals.counts(), refusals.topic());
        let recorded = accounting.record(times, input, output);
        let mut pulse = self.pulse.loan()?;
        *pulse = Pulse { refused, refused_topic, ..recorded };
        pulse.send_as_is()
    }

    /// An injected slowness: uses up time as a step that runs away would.
    fn inject_slowness(&mut self, started_ns: u64) {
        if self.slowed_cycles > 0 {
            self.slowed_cycles -= 1;
            while now() < started_ns + self.slowdown.as_nanos() as u64 {
                std::hint::spin_loop();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::{Bus, Input};
    use allocation_counter::measure;
    use coact_messages::{Command, SensorSample, topic};
    use coact_pipeline::{Pipeline, Run, RunSettings};

    /// Cycles in which connections are made and buffers reach their size.
    const WARM_UP: u64 = 20;
    const CYCLES: u64 = 200;
    /// The cycle's own output, and its pulse: iceoryx2 makes one allocation for each loan.
    const LOANS: u64 = 2;

    struct Source {
        command: Input<Command>,
        sample: Output<SensorSample>,
    }

    impl Cycle for Source {
        type Trigger = Command;

        fn trigger(&mut self) -> &mut Input<Command> {
            &mut self.command
        }

        fn step(&mut self, tick: Tick) -> Result<Header, PortError> {
            self.sample.loan()?.send(tick.cycle, tick.started_ns)
        }
    }

    /// Allocations of each cycle, from its wait to its pulse.
    fn allocations(run: &Run) -> Vec<u64> {
        let table = "[[process]]\nname = \"world\"\nprogram = \"none\"\norder = 1\ntrigger = \"timer\"\n";
        let pipeline = Pipeline::parse(table, "table".as_ref()).unwrap();
        let bus = Bus::open(run, "world", 0).unwrap();
        let mut work = Source {
            command: bus.input(topic::COMMAND).unwrap(),
            sample: bus.output(topic::SENSORS).unwrap(),
        };
        let pulse = bus.output(&topic::pulse("world")).unwrap();
        let schedule = Schedule { start_ns: now() };
        let mut executor = Executor::new(&pipeline.processes[0], schedule, false, pulse, Arc::default());
        let signals = Signals::install().unwrap();
        let mut cycle = |cycle| {
            let scheduled_ns = executor.wait(cycle, &mut work, &signals).unwrap();
            executor.run_cycle(cycle, scheduled_ns, &mut work).unwrap();
        };
        (1..=WARM_UP + CYCLES).map(|tick| measure(|| cycle(tick)).count_total).collect()
    }

    #[test]
    fn steady_cycle_allocates_once_for_each_loan() {
        let run = Run::create(RunSettings::default()).unwrap();
        let counts = allocations(&run);
        run.remove().unwrap();
        assert_eq!(counts[WARM_UP as usize..], [LOANS; CYCLES as usize]);
    }
}
