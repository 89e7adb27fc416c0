use crate::monotonic_clock::{now, timespec};
use crate::{LateWakeUp, Schedule, WakeUpLateness, scheduling};
use coact_period::PERIOD_NS;
use coact_pipeline::{Pipeline, ProcessEntry, Trigger};
use crossbeam::queue::ArrayQueue;
use rustix::thread::clock_nanosleep_absolute;
use rustix::time::ClockId;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::thread::JoinHandle;

/// A thread that only wakes up once in each period, on the core of the process that starts the chain and before all of the chain.
///
/// Its lateness is the machine's own, whatever the chain does: the same measurement as cyclictest's.
#[derive(Debug)]
pub struct LatencyProbe {
    counters: Arc<Counters>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug)]
struct Counters {
    wakeups: AtomicU64,
    late: AtomicU64,
    longest_ns: AtomicU64,
    /// How many wake-ups were late by so many whole microseconds; the last one counts all that were later.
    by_us: Vec<AtomicU64>,
    /// The newest that were late and that nobody has taken yet.
    late_ones: ArrayQueue<LateWakeUp>,
    stop: AtomicBool,
}

/// Lateness is told apart up to this, µs: ten periods. Of what is later, only the number and the greatest are of interest.
const LONGEST_US: usize = 10_000;
/// So many late wake-ups are kept: those of seconds on the worst machine, and they are taken each few milliseconds.
const LATE_ONES: usize = 1024;

impl LatencyProbe {
    /// Starts to measure, half a period after each release, when the chain rests.
    ///
    /// `None` where no process of the table is released by the timer, or the system grants no thread.
    pub fn start(pipeline: &Pipeline, schedule: Schedule) -> Option<Self> {
        let entry = entry(pipeline)?;
        let counters = Arc::new(Counters::new());
        let of_thread = Arc::clone(&counters);
        let body = move || {
            // Refused, it is scheduled like the chain, which was refused the same.
            let _ = (scheduling::take_core(&entry), scheduling::take_class(&entry));
            of_thread.measure(schedule);
        };
        let thread = std::thread::Builder::new().name("latency-probe".into()).spawn(body).ok()?;
        Some(Self { counters, thread: Some(thread) })
    }

    /// The wake-ups that came late by half a period or more, oldest first; each is told once. The chain, released half a period before, may
    /// have lost a whole one.
    pub fn take_late(&self) -> impl Iterator<Item = LateWakeUp> + '_ {
        std::iter::from_fn(|| self.counters.late_ones.pop())
    }

    /// What it has measured so far.
    pub fn lateness(&self) -> WakeUpLateness {
        let Counters { wakeups, late, longest_ns, .. } = &*self.counters;
        let longest_ns = longest_ns.load(Relaxed);
        WakeUpLateness {
            wakeups: wakeups.load(Relaxed),
            late: late.load(Relaxed),
            p999_ns: self.counters.quantile_ns(0.999).min(longest_ns),
            longest_ns,
        }
    }
}

/// As the process that starts the chain, but one priority above all: no stage that takes long makes the machine seem late.
fn entry(pipeline: &Pipeline) -> Option<ProcessEntry> {
    let first = pipeline.processes.iter().find(|entry| entry.trigger == Trigger::Timer)?;
    let highest = pipeline.processes.iter().filter(|entry| entry.realtime).map(|entry| entry.priority).max();
    let priority = highest.map_or(first.priority, |highest| (highest + 1).min(ProcessEntry::HIGHEST));
    Some(ProcessEntry { priority, ..first.clone() })
}

impl Drop for LatencyProbe {
    fn drop(&mut self) {
        self.counters.stop.store(true, Relaxed);
        // It ends within a period; that it panicked would be nothing to act upon.
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

impl Counters {
    fn new() -> Self {
        let by_us = std::iter::repeat_with(AtomicU64::default).take(LONGEST_US + 1).collect();
        let count = AtomicU64::default;
        let (late_ones, stop) = (ArrayQueue::new(LATE_ONES), AtomicBool::new(false));
        Self { wakeups: count(), late: count(), longest_ns: count(), by_us, late_ones, stop }
    }

    /// This fraction of the wake-ups was no later, ns, rounded up to whole microseconds.
    fn quantile_ns(&self, quantile: f64) -> u64 {
        let counts: Vec<u64> = self.by_us.iter().map(|count| count.load(Relaxed)).collect();
        let wanted = (quantile * counts.iter().sum::<u64>() as f64).ceil() as u64;
        let mut reached = 0;
        let found = counts.iter().position(|count| {
            reached += count;
            reached >= wanted
        });
        match found {
            Some(LONGEST_US) | None => u64::MAX,
            Some(us) => (us as u64 + 1) * 1000,
        }
    }

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
            if late_by >= half {
                self.late_ones.force_push(LateWakeUp { due_ns: due(tick), woken_ns: woken });
            }
            self.longest_ns.fetch_max(late_by, Relaxed);
            self.by_us[LONGEST_US.min((late_by / 1000) as usize)].fetch_add(1, Relaxed);
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
        let late: Vec<_> = probe.take_late().collect();
        let seen = probe.lateness();
        drop(probe);
        let periods = (now() - start) / PERIOD_NS;
        assert!((1..=periods).contains(&seen.wakeups), "{seen:?} in {periods} periods");
        assert!(
            late.iter().all(|late| late.woken_ns - late.due_ns >= PERIOD_NS / 2)
                && late.len() as u64 >= seen.late
        );
        assert!(seen.late <= seen.wakeups && seen.wakeups + seen.longest_ns / PERIOD_NS >= 10, "{seen:?}");
    }

    #[test]
    fn it_comes_before_all_of_the_chain() {
        let table = |priority: u8| {
            pipeline(&format!(
                "name = \"world\"\nrealtime = true\npriority = 7\ncore = 1\ntrigger = \"timer\"\n\
                 [[process]]\nname = \"control\"\nprogram = \"none\"\norder = 2\nrealtime = true\npriority = {priority}\n"
            ))
        };
        let scheduled = |priority| entry(&table(priority)).map(|entry| (entry.priority, entry.core));
        assert_eq!([9, 99].map(scheduled), [Some((10, Some(1))), Some((99, Some(1)))]);
    }

    #[test]
    fn one_wake_up_in_a_thousand_is_later_than_the_quantile() {
        let counters = Counters::new();
        counters.by_us[3].store(999, Relaxed);
        counters.by_us[70].store(1, Relaxed);
        assert_eq!(counters.quantile_ns(0.999), 4000);
        counters.by_us[70].store(2, Relaxed);
        assert_eq!(counters.quantile_ns(0.999), 71_000);
        counters.by_us[LONGEST_US].store(9, Relaxed);
        assert_eq!(counters.quantile_ns(0.999), u64::MAX, "only the greatest lateness bounds it");
    }

    #[test]
    fn a_table_without_a_timer_has_no_probe() {
        let table = pipeline("name = \"voice\"\n");
        assert!(LatencyProbe::start(&table, Schedule { start_ns: now() }).is_none());
    }
}
