use std::time::Duration;

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// Its duration was over.
    DurationOver,
    /// All subgoals were achieved.
    Achieved,
    /// It was to last until all subgoals were achieved, and that took too long.
    TooLong,
    /// Ctrl-C or SIGTERM.
    Interrupted,
}

/// When a run ends by itself.
#[derive(Debug)]
pub(crate) struct EndCondition {
    /// The duration that was requested; without it, the run ends when all subgoals are achieved.
    duration: Option<Duration>,
    achieved_at: Option<Duration>,
}

impl EndCondition {
    /// Longest run without a duration. Chosen by hand: far longer than the shipped tasks take.
    pub(crate) const MAX_DURATION: Duration = Duration::from_secs(300);
    /// From the last subgoal to the end: long enough to see the robot go to rest. Chosen by hand.
    const AFTER_ACHIEVED: Duration = Duration::from_secs(2);

    pub(crate) fn new(duration: Option<Duration>) -> Self {
        Self { duration, achieved_at: None }
    }

    /// How the run ends, if it ends at this time after tick 0.
    pub(crate) fn check(&mut self, elapsed: Duration, all_achieved: bool) -> Option<Ending> {
        if let Some(duration) = self.duration {
            return (elapsed >= duration).then_some(Ending::DurationOver);
        }
        if self.achieved_at.is_none() && all_achieved {
            self.achieved_at = Some(elapsed);
        }
        match self.achieved_at {
            Some(at) if elapsed >= at + Self::AFTER_ACHIEVED => Some(Ending::Achieved),
            _ => (elapsed >= Self::MAX_DURATION).then_some(Ending::TooLong),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Duration = Duration::from_secs(1);

    #[test]
    fn with_a_duration_it_ends_then_whatever_is_achieved() {
        let mut end = EndCondition::new(Some(9 * SECOND));
        assert_eq!((end.check(SECOND, true), end.check(8 * SECOND, true)), (None, None));
        assert_eq!(end.check(9 * SECOND, false), Some(Ending::DurationOver));
    }

    #[test]
    fn without_one_it_ends_a_little_after_the_last_subgoal_even_if_the_scene_is_laid_out_again() {
        let mut end = EndCondition::new(None);
        assert_eq!((end.check(SECOND, false), end.check(3 * SECOND, true)), (None, None));
        assert_eq!(end.check(4 * SECOND, false), None);
        assert_eq!(end.check(5 * SECOND, false), Some(Ending::Achieved));
    }

    #[test]
    fn without_one_it_does_not_last_for_ever() {
        let mut end = EndCondition::new(None);
        assert_eq!(end.check(299 * SECOND, false), None);
        assert_eq!(end.check(300 * SECOND, false), Some(Ending::TooLong));
    }
}
