use crate::death::Death;
use crate::kill_reason::KillReason;
use crate::running::Running;
use crate::spare::Spare;
use crate::start_fault::StartFault;
use crate::watchdog::Silence;
use crate::{Fault, ProcessSpec, RestartHistory, RunningChild};
use coact_pipeline::Ready;
use rustix::process::Signal;
use std::io::{self, ErrorKind};
use std::time::Duration;

/// One process of the set, in all its generations.
#[derive(Debug)]
pub(crate) struct Supervised {
    pub(crate) spec: ProcessSpec,
    pub(crate) generation: u32,
    pub(crate) lifecycle: Lifecycle,
    pub(crate) history: RestartHistory,
    /// Of replacements that found no place on a topic: no fault of theirs, so these deaths are counted apart.
    pub(crate) refusals: RestartHistory,
    /// Fault that was injected and not yet recovered from; the events that it causes name it.
    pub(crate) fault: Option<Fault>,
    /// What is to be done to the next replacement before it is ready.
    pub(crate) start_fault: Option<StartFault>,
    /// It was given its predecessor's checkpoint.
    pub(crate) resumed: bool,
    /// The next replacement begins without one: its predecessor died of it.
    pub(crate) begins_anew: bool,
    /// It died while the run had no supervisor, who would have kept its checkpoint.
    pub(crate) died_unseen: bool,
    /// The next one, started ahead.
    pub(crate) spare: Option<Spare>,
    /// How long the first start took until it was ready.
    pub(crate) first_start: Option<Duration>,
    /// The supervisor itself cannot see whether it is ready: for want of a file handle.
    cannot_look: bool,
}

/// What state a process is in.
#[derive(Debug)]
pub(crate) enum Lifecycle {
    /// Not started yet: processes of a lower order are not ready.
    Waiting,
    /// Running, ready or not.
    Running(Box<Running>),
    /// Dead; its replacement is to be started at this time.
    RestartDue(Duration),
    /// Ended, and not to be started again.
    Stopped,
}

impl Supervised {
    /// How long after its start a replacement gets a [`StartFault`]: while it opens its ports. Chosen by hand; one is ready after
    /// 6 to 9 ms.
    const START_FAULT_AFTER: Duration = Duration::from_millis(2);

    /// A replacement that ends by itself sooner than this died of the state that it took up: what is wrong in it shows within
    /// some cycles, and later on it works on its own. Chosen by hand.
    const OWN_STATE: Duration = Duration::from_millis(500);
    /// A replacement that takes so many times as long as the first start did is stuck. Chosen by hand: the first start has
    /// the machine to share with all others, a replacement with the running chain.
    const STARTS_TIMES_USUAL: u32 = 10;
    /// No start is stuck before this time: below it, the machine's lateness counts. Chosen by hand.
    const SHORTEST_START_LIMIT: Duration = Duration::from_millis(200);
    /// A process that follows the run at its own pace shows a sign of life ten times a second; one that has shown none for
    /// so long hangs. Chosen by hand.
    const HEARTBEAT_WITHIN: Duration = Duration::from_secs(1);
    /// The same of one that would go on but has no core: to kill and replace it would take more of what it lacks. Chosen by hand.
    const STARVED_WITHIN: Duration = Duration::from_secs(10);

    pub(crate) fn new(spec: ProcessSpec) -> Self {
        Self {
            spec,
            generation: 0,
            lifecycle: Lifecycle::Waiting,
            history: RestartHistory::default(),
            refusals: RestartHistory::default(),
            fault: None,
            start_fault: None,
            resumed: false,
            begins_anew: false,
            died_unseen: false,
            spare: None,
            first_start: None,
            cannot_look: false,
        }
    }

    /// Whether it died of the checkpoint that it was given.
    pub(crate) fn died_of_its_state(&self, death: &Death) -> bool {
        self.resumed && self.fault.is_none() && death.by_itself && death.lived < Self::OWN_STATE
    }

    pub(crate) fn running(&self) -> Option<&Running> {
        match &self.lifecycle {
            Lifecycle::Running(running) => Some(running),
            _ => None,
        }
    }

    pub(crate) fn running_mut(&mut self) -> Option<&mut Running> {
        match &mut self.lifecycle {
            Lifecycle::Running(running) => Some(running),
            _ => None,
        }
    }

    pub(crate) fn is_ready(&self) -> bool {
        self.running().is_some_and(|running| running.ready)
    }

    /// Whether the others need not wait for it: it is ready, or it is not needed and has died already.
    pub(crate) fn keeps_nobody_waiting(&self) -> bool {
        self.is_ready() || !self.spec.needed && self.history.has_deaths()
    }

    /// Starts its spare, when it has none and has been ready for long enough. One that cannot be started is tried again.
    pub(crate) fn keep_spare(&mut self, now: Duration, on_line: impl FnMut(&str) + Send + 'static) {
        self.spare = self.spare.take().filter(|spare| !spare.is_dead());
        let settled =
            self.running().is_some_and(|running| running.ready && now >= running.since + Spare::AFTER);
        if !self.spec.spare || self.spare.is_some() || !settled {
            return;
        }
        match Spare::start(&self.spec, self.generation + 1, on_line) {
            Ok(spare) => self.spare = Some(spare),
            Err(error) => tracing::debug!("no spare of {}: {error}", self.spec.name),
        }
    }

    /// The process of this generation: its spare, or else one that is started now.
    ///
    /// # Errors
    /// The program cannot be executed.
    pub(crate) fn next(&mut self, on_line: impl FnMut(&str) + Send + 'static) -> io::Result<RunningChild> {
        let spare = self.spare.take().and_then(|spare| spare.take_turn(self.generation, self.spec.realtime));
        match spare {
            Some(child) => Ok(child),
            None => RunningChild::spawn(&self.spec, self.generation, on_line),
        }
    }

    /// Enters a child that was just started.
    pub(crate) fn started(&mut self, child: RunningChild, now: Duration) {
        // A predecessor's heartbeat is none of this one's.
        std::fs::remove_file(&self.spec.heartbeat_file).ok();
        let at_start = self.start_fault.map(|fault| (now + Self::START_FAULT_AFTER, fault));
        self.start_fault = self.start_fault.filter(|fault| fault.is_repeated());
        self.lifecycle = Lifecycle::Running(Box::new(Running::new(child, now, at_start)));
    }

    /// Enters a process of a dead supervisor's set, which reported `ready` to that one. `watched` is the time of the watch clock.
    pub(crate) fn adopted(&mut self, child: RunningChild, ready: &Ready, now: Duration, watched: Duration) {
        let mut running = Running::new(child, now, None);
        (running.ready, running.last_sign, running.is_realtime) = (true, watched, ready.priority > 0);
        self.generation = ready.generation;
        self.lifecycle = Lifecycle::Running(Box::new(running));
    }

    /// Its death, if it died; its replacement is due from then on.
    pub(crate) fn died(&mut self, now: Duration) -> Option<Death> {
        let child = &self.running()?.child;
        let status = child.is_dead().then(|| child.exit_status())?;
        let Lifecycle::Running(running) = std::mem::replace(&mut self.lifecycle, Lifecycle::RestartDue(now))
        else {
            return None;
        };
        Some(Death::new(*running, status, now))
    }

    /// True once, when its ready file has appeared. `watched` is the time of the watch clock.
    pub(crate) fn becomes_ready(&mut self, now: Duration, watched: Duration) -> bool {
        if self.running().is_none_or(|running| running.ready) {
            return false;
        }
        let report = std::fs::read(self.spec.ready_file(self.generation));
        self.cannot_look = report.as_ref().is_err_and(|error| error.kind() != ErrorKind::NotFound);
        let Ok(report) = report else { return false };
        let is_first = self.generation == 0;
        let Some(running) = self.running_mut() else { return false };
        if running.at_start.is_some() || running.kill_reason.is_some() {
            return false;
        }
        running.ready = true;
        running.last_sign = watched;
        // Whatever does not say that it is real time is not taken for it.
        let ready = serde_json::from_slice::<Ready>(&report).unwrap_or_default();
        running.is_realtime = ready.priority > 0;
        running.child.watch_sentinel(ready.sentinel);
        let took = now.saturating_sub(running.since);
        if is_first {
            self.first_start = Some(took);
        }
        true
    }

    /// How long its present start may take: the first one what the table says, a replacement's little more than usual.
    fn start_limit(&self) -> Duration {
        let usual = self.first_start.filter(|_| self.generation > 0);
        let limit = usual.map(|usual| (Self::STARTS_TIMES_USUAL * usual).max(Self::SHORTEST_START_LIMIT));
        limit.map_or(self.spec.ready_within, |limit| limit.min(self.spec.ready_within))
    }

    /// Takes in its heartbeat: a file that it touches. One that never did is not watched by it.
    pub(crate) fn take_heartbeat(&mut self, watched: Duration) {
        let file = &self.spec.heartbeat_file;
        let Lifecycle::Running(running) = &mut self.lifecycle else { return };
        let Ok(beat) = std::fs::metadata(file).and_then(|metadata| metadata.modified()) else { return };
        if running.heartbeat != Some(beat) {
            running.beats(beat, watched);
        }
    }

    /// Kills it when its heartbeat stopped; when it only has no core, later.
    pub(crate) fn watch_heartbeat(&mut self, watched: Duration) {
        let Some(running) = self.running_mut().filter(|running| running.ready && running.heartbeat.is_some())
        else {
            return;
        };
        let silence = watched.saturating_sub(running.last_sign);
        let starves = silence > Self::HEARTBEAT_WITHIN && running.starves(silence);
        let limit = if starves { Self::STARVED_WITHIN } else { Self::HEARTBEAT_WITHIN };
        if silence > limit {
            running.kill(KillReason::NoHeartbeat(limit));
        }
    }

    /// How long it has been silent, if it is one that sends pulses in each cycle.
    pub(crate) fn silence(&mut self, watched: Duration, pulses_from: Duration) -> Option<Silence> {
        let limit = self.spec.hung_after?;
        let running = self.running_mut().filter(|running| running.ready)?;
        let for_time = watched.saturating_sub(running.last_sign.max(pulses_from));
        Some(Silence {
            for_time,
            limit,
            is_steady: running.has_pulsed && running.is_realtime,
            certain: running.certain_limit(for_time, limit, watched),
            core: self.spec.core,
        })
    }

    /// Whether it sleeps for what never comes, though its core goes on.
    pub(crate) fn sleeps_without_end(
        &mut self,
        core_goes_on: bool,
        silence: &Silence,
        watched: Duration,
    ) -> bool {
        self.running_mut().is_some_and(|running| {
            running.sleeps_without_end(core_goes_on, silence.for_time, silence.limit, watched)
        })
    }

    /// Kills it when it is not ready in time; does what an injected fault does to one that starts; continues it when its injected pause is
    /// over.
    pub(crate) fn look(&mut self, now: Duration) {
        let (ready_within, cannot_look) = (self.start_limit(), self.cannot_look);
        let Lifecycle::Running(running) = &mut self.lifecycle else { return };
        if running.continue_at.is_some_and(|due| now >= due) {
            running.continue_at = None;
            running.child.signal(Signal::CONT);
            self.fault = None;
        }
        // Until it is killed: one that is stuck never becomes ready, even if it was quicker than the fault.
        if let Some((_, fault)) = running.at_start.filter(|(due, _)| now >= *due) {
            match fault {
                StartFault::Crash | StartFault::CrashLoop => running.kill(KillReason::InjectedCrash),
                StartFault::Stuck => running.child.signal(Signal::STOP),
            }
        }
        if !running.ready && !cannot_look && now.saturating_sub(running.since) > ready_within {
            running.kill(KillReason::NotReadyInTime(ready_within));
        }
    }

    /// Requests that it ends; SIGCONT, because a stopped process would not see the request.
    pub(crate) fn request_stop(&mut self) {
        if let Some(running) = self.running() {
            running.child.signal(Signal::TERM);
            running.child.signal(Signal::CONT);
        }
    }

    /// Kills it when it did not end within its grace, `elapsed` after the request.
    pub(crate) fn kill_after_grace(&mut self, elapsed: Duration) {
        let grace = self.spec.stop_grace;
        if let Some(running) = self.running_mut().filter(|_| elapsed > grace) {
            running.kill(KillReason::DidNotStop(grace));
        }
    }
}
