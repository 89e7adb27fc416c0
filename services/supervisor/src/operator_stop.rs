use crate::operator::Operator;
use coact_messages::{StopState, topic};
use coact_realtime::{Bus, Output, PortError, Schedule, monotonic_time, now};
use coact_run_records::SupervisorEventKind;
use std::time::Duration;

/// The operator's stop: a latch that only an operator sets and releases.
///
/// It lives here because nothing else of the set outlives every other process: no death of a stage, of its replacement or of
/// the operator's own program touches it. The supervisor repeats the state of the latch for as long as the set lives, so that
/// a replacement hears it; who drives the joints stands until it has heard it, and when it hears it no more.
pub(crate) struct OperatorStop {
    output: Output<StopState>,
    latch: Latch,
    /// When the state is repeated next, `CLOCK_MONOTONIC`.
    repeat_at: Duration,
    failed: bool,
}

/// Whether the robot is stopped, and who wanted it so, since when.
#[derive(Debug, Default)]
struct Latch {
    stopped_by: Option<(Operator, Duration)>,
}

/// What an operator wants.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StopRequest {
    /// The robot brakes, and stands until it may go on.
    Stop,
    /// It may go on.
    Resume,
}

impl OperatorStop {
    /// Chosen by hand: a replacement of the world hears the state before its first cycle, and who drives the joints hears it
    /// fifty times in the time after which it stands without.
    const REPEATED_EVERY: Duration = Duration::from_millis(10);

    /// A released latch.
    ///
    /// # Errors
    /// Shared memory refuses the topic.
    pub(crate) fn new(bus: &Bus) -> Result<Self, PortError> {
        let output = bus.output(topic::STOP)?;
        Ok(Self { output, latch: Latch::default(), repeat_at: Duration::ZERO, failed: false })
    }

    /// Does what the operator wants, and publishes it at once. Returns what has changed, or in words why nothing had to.
    pub(crate) fn request(
        &mut self,
        request: StopRequest,
        operator: Operator,
        schedule: Option<Schedule>,
    ) -> Result<SupervisorEventKind, String> {
        let changed = self.latch.request(request, operator, monotonic_time())?;
        self.repeat_at = Duration::ZERO;
        self.repeat(schedule);
        Ok(changed)
    }

    /// Repeats the state of the latch when that is due.
    pub(crate) fn repeat(&mut self, schedule: Option<Schedule>) {
        if monotonic_time() < self.repeat_at {
            return;
        }
        self.repeat_at = monotonic_time() + Self::REPEATED_EVERY;
        // Unheard, the joints stand: the safe side. The first failure is warned of, and the next repetition tries again.
        if let (Err(error), false) = (self.publish(schedule), self.failed) {
            self.failed = true;
            tracing::warn!("nobody hears whether the robot may move, so it stands: {error}");
        }
    }

    fn publish(&mut self, schedule: Option<Schedule>) -> Result<(), PortError> {
        let stamp = now();
        let cycle = schedule.map_or(0, |schedule| schedule.tick_at(stamp));
        let mut message = self.output.loan()?;
        (message.stopped, message.reserved) = (u32::from(self.latch.stopped_by.is_some()), 0);
        message.send(cycle, stamp)?;
        Ok(())
    }
}

impl Latch {
    fn request(
        &mut self,
        request: StopRequest,
        operator: Operator,
        now: Duration,
    ) -> Result<SupervisorEventKind, String> {
        match (request, self.stopped_by) {
            (StopRequest::Stop, Some((by, since))) => {
                let ago = now.saturating_sub(since).as_secs_f64();
                Err(format!("already stopped, by {by}, {ago:.1} s ago"))
            }
            (StopRequest::Resume, None) => Err("not stopped".into()),
            (StopRequest::Stop, None) => {
                self.stopped_by = Some((operator, now));
                Ok(SupervisorEventKind::OperatorStopped)
            }
            (StopRequest::Resume, Some(_)) => {
                self.stopped_by = None;
                Ok(SupervisorEventKind::OperatorResumed)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: Operator = Operator { user: 1000, pid: 7 };
    const OTHER: Operator = Operator { user: 0, pid: 9 };
    const SECOND: Duration = Duration::from_secs(1);

    #[test]
    fn a_stop_lasts_until_somebody_resumes_and_says_whose_it_is() {
        let mut latch = Latch::default();
        assert_eq!(latch.request(StopRequest::Resume, ONE, SECOND), Err("not stopped".into()));
        let stopped = Ok(SupervisorEventKind::OperatorStopped);
        assert_eq!(latch.request(StopRequest::Stop, ONE, SECOND), stopped);
        let again = latch.request(StopRequest::Stop, OTHER, 3 * SECOND);
        assert_eq!(again, Err("already stopped, by user 1000 (pid 7), 2.0 s ago".into()));
        assert!(latch.stopped_by.is_some());
        let resumed = Ok(SupervisorEventKind::OperatorResumed);
        assert_eq!(latch.request(StopRequest::Resume, OTHER, 4 * SECOND), resumed);
        assert!(latch.stopped_by.is_none());
        assert_eq!(latch.request(StopRequest::Stop, OTHER, 5 * SECOND), stopped);
    }
}
