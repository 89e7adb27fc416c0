use coact_pipeline::ProcessStat;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

/// A thread of a process that is not real time, as another one of its threads sees it.
#[derive(Debug, Clone, Default)]
pub struct BackgroundThread {
    /// 0 until it runs.
    id: Arc<AtomicU32>,
    /// For how long it had computed at the last look.
    computed: Duration,
}

/// One that computes for less than this part of the time does not get its core. Chosen by hand, as the supervisor's.
const STARVED: f64 = 0.1;

impl BackgroundThread {
    /// The thread that calls this is the one.
    pub(crate) fn begin(&self) {
        self.id.store(rustix::thread::gettid().as_raw_nonzero().get() as u32, Ordering::Relaxed);
    }

    /// Whether it would go on but for the machine, and hardly has in the time `since` the last look: it has no core, or waits for memory or a
    /// file. One that stands still or computes without end does not starve. What the first look says of one that has computed before is not
    /// true: it is what the second one compares with. It takes some system calls.
    pub fn starves(&mut self, since: Duration) -> bool {
        let Ok(stat) = ProcessStat::of_thread(self.id.load(Ordering::Relaxed)) else { return false };
        let computed = stat.computed.saturating_sub(self.computed);
        self.computed = stat.computed;
        (stat.is_runnable || stat.is_in_kernel) && computed < since.mul_f64(STARVED)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::scheduling;
    use std::sync::atomic::AtomicBool;

    /// Whether a thread starves that does this, some time after it began.
    fn starves(work: impl Fn(&AtomicBool) + Send + Sync) -> bool {
        let (over, mut thread) = (AtomicBool::new(false), BackgroundThread::default());
        let known = thread.clone();
        std::thread::scope(|scope| {
            scope.spawn(|| {
                known.begin();
                work(&over);
            });
            let time = Duration::from_millis(300);
            std::thread::sleep(time);
            let starves = thread.starves(time);
            over.store(true, Ordering::Relaxed);
            starves
        })
    }

    #[test]
    fn one_of_many_on_a_core_starves() {
        const OTHERS: usize = 30;
        let (over, mut thread) = (AtomicBool::new(false), BackgroundThread::default());
        let known = thread.clone();
        let spin = || {
            scheduling::keep_to_first_core();
            while !over.load(Ordering::Relaxed) {
                std::hint::spin_loop();
            }
        };
        std::thread::scope(|scope| {
            scope.spawn(|| {
                known.begin();
                spin();
            });
            // It has computed for long before it starves.
            std::thread::sleep(Duration::from_millis(100));
            (0..OTHERS).for_each(|_| _ = scope.spawn(spin));
            let time = Duration::from_millis(400);
            std::thread::sleep(time);
            thread.starves(time);
            std::thread::sleep(time);
            let starves = thread.starves(time);
            over.store(true, Ordering::Relaxed);
            assert!(starves);
        });
    }

    #[test]
    fn one_that_stands_still_or_computes_does_not_starve() {
        let is_over = |over: &AtomicBool| over.load(Ordering::Relaxed);
        assert!(!starves(|over| while !is_over(over) {
            std::thread::sleep(Duration::from_millis(400));
        }));
        assert!(!starves(|over| while !is_over(over) {
            std::hint::spin_loop();
        }));
        assert!(!BackgroundThread::default().starves(Duration::ZERO), "nobody began");
    }
}
