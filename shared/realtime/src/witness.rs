use crate::clock::{now, timespec};
use crate::{Schedule, scheduling};
use coact_pipeline::{Pipeline, Trigger};
use rustix::thread::clock_nanosleep_absolute;
use rustix::time::ClockId;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::thread::JoinHandle;

/// A thread that does nothing but wake up once in each period, scheduled like the process that starts the chain: what
/// it sees late, the machine was late by, whatever the chain did. The same measurement as cyclictest's.
#[derive(Debug)]
pub struct Witness {
    seen: Arc<Seen>,
    thread: Option<JoinHandle<()>>,
}

/// What a [`Witness`] has seen.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Punctuality {
    /// How often it woke up.
    pub wakeups: u64,
    /// How often it did so a whole period late, or later.
    pub late: u64,
    /// The longest that it was late by, ns.
    pub longest_ns: u64,
}

#[derive(Debug, Default)]
struct Seen {
    wakeups: AtomicU64,
    late: AtomicU64,
    longest_ns: AtomicU64,
    stop: AtomicBool,
}

impl Witness {
    /// Starts to watch, half a period after each release: the chain rests then. `None` where no process of the table
    /// is released by the timer, or no thread can be had.
    pub fn start(pipeline: &Pipeline, schedule: Schedule) -> Option<Self> {
        let first = pipeline.processes.iter().find(|entry| entry.trigger == Trigger::Timer)?.clone();
        let seen = Arc::new(Seen::default());
        let witness = Arc::clone(&seen);
        let body = move || {
            // Refused, it is scheduled like the chain, which was refused the same.
            let _ = scheduling::request(&first);
            witness.watch(schedule);
        };
        let thread = std::thread::Builder::new().name("witness".into()).spawn(body).ok()?;
        Some(Self { seen, thread: Some(thread) })
    }

    /// So far.
    pub fn punctuality(&self) -> Punctuality {
        let Seen { wakeups, late, longest_ns, .. } = &*self.seen;
        Punctuality {
            wakeups: wakeups.load(Relaxed),
            late: late.load(Relaxed),
            longest_ns: longest_ns.load(Relaxed),
        }
    }
}

impl Drop for Witness {
    fn drop(&mut self) {
        self.seen.stop.store(true, Relaxed);
        // It ends within a period; that it panicked would be nothing to act upon.
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

impl Seen {
    fn watch(&self, schedule: Schedule) {
        let half = schedule.period_ns / 2;
        let due = |tick| schedule.release(tick) + half;
        let mut tick = schedule.next_after(now());
        while !self.stop.load(Relaxed) {
            while clock_nanosleep_absolute(ClockId::Monotonic, &timespec(due(tick))).is_err() {}
            let woken = now();
            let late_by = woken.saturating_sub(due(tick));
            self.wakeups.fetch_add(1, Relaxed);
            self.late.fetch_add(u64::from(late_by >= schedule.period_ns), Relaxed);
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

    #[test]
    fn it_wakes_up_once_a_period_and_ends_when_it_is_dropped() {
        let table = "period_us = 5000\n[[process]]\nname = \"world\"\nprogram = \"none\"\norder = 1\n\
                     trigger = \"timer\"\n";
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), table).unwrap();
        let pipeline = Pipeline::load(file.path()).unwrap();
        let start = now();
        let witness = Witness::start(&pipeline, Schedule { start_ns: start, period_ns: 5_000_000 }).unwrap();
        std::thread::sleep(Duration::from_millis(103));
        let seen = witness.punctuality();
        drop(witness);
        let periods = (now() - start) / 5_000_000;
        assert!((1..=periods).contains(&seen.wakeups), "{seen:?} in {periods} periods");
        assert!(seen.late <= seen.wakeups && seen.wakeups + seen.longest_ns / 5_000_000 >= 10, "{seen:?}");
    }

    #[test]
    fn a_table_without_a_timer_has_no_witness() {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), "[[process]]\nname = \"voice\"\nprogram = \"none\"\norder = 1\n")
            .unwrap();
        let pipeline = Pipeline::load(file.path()).unwrap();
        assert!(Witness::start(&pipeline, Schedule { start_ns: now(), period_ns: 1_000_000 }).is_none());
    }
}
