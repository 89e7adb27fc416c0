use crate::monotonic_clock::{now, timespec};
use crate::{Schedule, WakeUpLateness, scheduling};
use coact_period::PERIOD_NS;
use coact_pipeline::{Pipeline, Trigger};
use rustix::thread::clock_nanosleep_absolute;
use rustix::time::ClockId;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::thread::JoinHandle;

/// A thread that only wakes up once in each period, scheduled like the process that starts the chain.
///
/// Its lateness is the machine's own, whatever the chain does: the same measurement as cyclictest's.
#[derive(Debug)]
pub struct LatencyProbe {
    counters: Arc<Counters>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug, Default)]
struct Counters {
    wakeups: AtomicU64,
    late: AtomicU64,
    longest_ns: AtomicU64,
    stop: AtomicBool,
}

impl LatencyProbe {
    /// Starts to measure, half a period after each release, when the chain rests.
    ///
    /// `None` where no process of the table is released by the timer, or the system grants no thread.
    pub fn start(pipeline: &Pipeline, schedule: Schedule) -> Option<Self> {
        let first = pipeline.processes.iter().find(|entry| entry.trigger == Trigger::Timer)?.clone();
        let counters = Arc::new(Counters::default());
        let of_thread = Arc::clone(&counters);
        let body = move || {
            // Refused, it is scheduled like the chain, which was refused the same.
            let _ = scheduling::apply(&first);
            of_thread.measure(schedule);
        };
        let thread = std::thread::Builder::new().name("latency-probe".into()).spawn(body).ok()?;
        Some(Self { counters, thread: Some(thread) })
    }

    /// What it has measured so far.
    pub fn lateness(&self) -> WakeUpLateness {
        let Counters { wakeups, late, longest_ns, .. } = &*self.counters;
        WakeUpLateness {
            wakeups: wakeups.load(Relaxed),
            late: late.load(Relaxed),
            longest_ns: longest_ns.load(Relaxed),
        }
    }
}

impl Drop for LatencyProbe {
    fn drop(&mut self) {
        self.counters.stop.store(true, Relaxed);
        // It ends within a period; that it panicked would be nothing to act upon.
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

impl Counters {
    fn measure(&self, schedule: Schedule) {
        let half = PERIOD_NS / 2;
        let due = |tick| schedule.release(tick) + half;
        let mut tick = schedule.next_after(now());
        while !self.stop.load(Relaxed) {
            while clock_nanosleep_absolute(ClockId::Monotonic, &timespec(due(tick))).is_err() {}
            let woken = now();
            let late_by = woken.saturating_sub(due(tick));
            self.wakeups.fetch_add(1, Relaxed);
            self.late.fetch_add(u64::from(late_by >= PERIOD_NS), Relaxed);
            self.longest_ns.fetch_max(late_by, Relaxed);
            tick = (tick + 1).max(schedule.next_after(woken.saturating_sub(half)));
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use std::time::Duration;

    fn pipeline(entry: &str) -> Pipeline {
        Pipeline::parse(&format!("[[process]]\nprogram = \"none\"\norder = 1\n{entry}"), "table".as_ref())
            .unwrap()
    }

    #[test]
    fn it_wakes_up_once_a_period_and_ends_when_it_is_dropped() {
        let start = now();
        let table = pipeline("name = \"world\"\ntrigger = \"timer\"\n");
        let probe = LatencyProbe::start(&table, Schedule { start_ns: start }).unwrap();
        std::thread::sleep(Duration::from_millis(103));
        let seen = probe.lateness();
        drop(probe);
        let periods = (now() - start) / PERIOD_NS;
        assert!((1..=periods).contains(&seen.wakeups), "{seen:?} in {periods} periods");
        assert!(seen.late <= seen.wakeups && seen.wakeups + seen.longest_ns / PERIOD_NS >= 10, "{seen:?}");
    }

    #[test]
    fn a_table_without_a_timer_has_no_probe() {
        let table = pipeline("name = \"voice\"\n");
        assert!(LatencyProbe::start(&table, Schedule { start_ns: now() }).is_none());
    }
}
