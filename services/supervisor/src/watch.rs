use crate::kill_reason::KillReason;
use crate::supervised::Supervised;
use crate::watch_clock::WatchClock;
use crate::watchdog::{self, Silence};
use coact_realtime::monotonic_time;
use std::time::Duration;

/// Looks at the processes of a set again and again, and kills what hangs: of the chain, by its pulses; of the others, by their
/// heartbeats.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    clock: WatchClock,
    /// When heartbeats are looked at next, by the watch clock.
    heartbeats_at: Duration,
    /// From when on pulses are expected; none while the run's clock does not run yet.
    pulses_from: Option<Duration>,
    /// The same by the watch clock, once that time has come.
    pulses_due_since: Option<Duration>,
}

impl Watch {
    /// How often heartbeats are looked at; they come as often. Chosen by hand; not sensitive.
    const HEARTBEAT_POLL: Duration = Duration::from_millis(100);

    /// The run's clock starts at `from`: pulses are expected from then on.
    pub(crate) fn expect_pulses(&mut self, from: Duration) {
        self.pulses_from = Some(from);
    }

    /// Whether the run's clock runs.
    pub(crate) fn run_has_begun(&self) -> bool {
        self.pulses_from.is_some_and(|from| monotonic_time() >= from)
    }

    /// The time watched so far.
    pub(crate) fn watched(&self) -> Duration {
        self.clock.watched()
    }

    /// Looks at those of the chain, and ten times a second at all of them: then true.
    pub(crate) fn look(&mut self, processes: &mut [Supervised]) -> bool {
        self.clock.look(monotonic_time());
        let at_all = self.watched() >= self.heartbeats_at;
        if at_all {
            self.look_at_heartbeats(processes);
        }
        if self.run_has_begun() {
            self.look_at_pulses(processes);
        }
        at_all
    }

    fn look_at_heartbeats(&mut self, processes: &mut [Supervised]) {
        let watched = self.watched();
        self.heartbeats_at = watched + Self::HEARTBEAT_POLL;
        for process in processes.iter_mut().filter(|process| process.spec.hung_after.is_none()) {
            process.take_heartbeat(watched);
            process.watch_heartbeat(watched);
        }
    }

    fn look_at_pulses(&mut self, processes: &mut [Supervised]) {
        let watched = self.watched();
        let due_since = *self.pulses_due_since.get_or_insert(watched);
        let silence = |process: &mut Supervised| process.silence(watched, due_since);
        let silences: Vec<Option<Silence>> = processes.iter_mut().map(silence).collect();
        let all: Vec<Silence> = silences.iter().flatten().copied().collect();
        let all_silent = watchdog::all_silent(&all);
        for (process, silence) in processes.iter_mut().zip(silences) {
            let Some(silence) = silence else { continue };
            let core_goes_on = watchdog::goes_on(silence.core, &all);
            let sleeps = process.sleeps_without_end(core_goes_on, &silence, watched);
            let limit = silence.longest(sleeps, all_silent);
            if let Some(running) = process.running_mut().filter(|_| silence.for_time > limit) {
                running.kill(KillReason::Hung(limit));
            }
        }
    }
}
