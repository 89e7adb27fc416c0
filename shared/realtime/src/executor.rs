use crate::accounts::{Accounts, CycleTimes};
use crate::clock::{now, timespec};
use crate::signals::Signals;
use crate::{Cycle, Output, PortError, ProcessError, Schedule, Tick};
use coact_messages::{Header, Pulse};
use coact_pipeline::{Pipeline, ProcessEntry, Trigger};
use rustix::thread::clock_nanosleep_absolute;
use rustix::time::ClockId;

/// The injected fault "slow": so many cycles ...
const SLOW_CYCLES: u32 = 50;
/// ... take so much longer each, ns.
const SLOW_NS: u64 = 2_000_000;

/// Runs a [`Cycle`] once in each period: wait, step, account.
pub(crate) struct Executor {
    schedule: Schedule,
    /// Offset from the release up to which a cycle waits for its input; `None`: it starts at the release.
    latest_start_ns: Option<u64>,
    accounts: Accounts,
    pulse: Output<Pulse>,
    slow_cycles: u32,
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
        pipeline: &Pipeline,
        entry: &ProcessEntry,
        schedule: Schedule,
        waits_for_topic: bool,
        pulse: Output<Pulse>,
    ) -> Self {
        Self {
            schedule,
            latest_start_ns: waits_for_topic.then_some(entry.latest_start_us * 1000),
            accounts: Accounts::new(pipeline.deadline_us * 1000),
            pulse,
            slow_cycles: 0,
        }
    }

    /// Runs until a signal asks to stop.
    pub(crate) fn run(&mut self, work: &mut impl Cycle, signals: &Signals) -> Result<(), PortError> {
        let mut cycle = self.schedule.next_after(now());
        loop {
            let scheduled_ns = self.wait(cycle, work, signals)?;
            if signals.stop() {
                return Ok(());
            }
            if signals.take_slow() {
                self.slow_cycles = SLOW_CYCLES;
            }
            self.cycle(cycle, scheduled_ns, work)?;
            cycle = self.schedule.following(cycle, now());
        }
    }

    /// Waits for the start of `cycle`; answers when it was due. A request to stop ends the wait early.
    fn wait(&self, cycle: u64, work: &mut impl Cycle, signals: &Signals) -> Result<u64, PortError> {
        let release = self.schedule.release(cycle);
        let trigger = work.trigger();
        let Some(latest_start) = self.latest_start_ns else {
            let asleep = || clock_nanosleep_absolute(ClockId::Monotonic, &timespec(release));
            while asleep().is_err() && !signals.stop() {}
            trigger.refresh()?;
            return Ok(release);
        };
        let latest = release + latest_start;
        let mut came = trigger.wait_for(cycle, latest)?;
        let woken = now();
        if !came && self.accounts.is_late(release, woken) {
            // It overslept its deadline, and so did the stages before it, which may not have had the core yet. With the
            // time that they always have, it works on what they sense now rather than on what is old.
            came = trigger.wait_for(cycle, woken + latest_start)?;
        }
        let published = trigger.header().map_or(0, |header| header.published_ns);
        Ok(if came { published.max(release) } else { latest })
    }

    fn cycle(&mut self, cycle: u64, scheduled_ns: u64, work: &mut impl Cycle) -> Result<(), PortError> {
        let started_ns = now();
        let released_ns = self.schedule.release(cycle);
        let input = work.trigger().header().copied();
        let received_ns = work.trigger().received_ns();
        self.be_slow(started_ns);
        let output = work.step(Tick { cycle, released_ns, started_ns })?;
        let times = CycleTimes { released_ns, scheduled_ns, started_ns, received_ns };
        self.report(times, input.as_ref(), output)
    }

    fn report(&mut self, times: CycleTimes, input: Option<&Header>, output: Header) -> Result<(), PortError> {
        let booked = self.accounts.book(times, input, output);
        let mut pulse = self.pulse.loan()?;
        *pulse = booked;
        pulse.send_as_is()
    }

    /// The injected fault: computes for nothing, as a step that runs away would.
    fn be_slow(&mut self, started_ns: u64) {
        if self.slow_cycles > 0 {
            self.slow_cycles -= 1;
            while now() < started_ns + SLOW_NS {
                std::hint::spin_loop();
            }
        }
    }
}
