use std::time::Duration;

/// How long the processes of the chain may be silent. All times are of the [watch clock](crate::watch_clock::WatchClock).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Silence {
    /// Since its last pulse, or since it became ready.
    pub(crate) for_time: Duration,
    /// How long it may be.
    pub(crate) limit: Duration,
    /// It is real time and has sent a pulse already: others' load does not delay it, and what it does once is done.
    pub(crate) is_steady: bool,
    /// How long it may be when no late machine explains it: it is stopped, or computes without end.
    pub(crate) certain: Option<Duration>,
    /// The core that it is pinned to.
    pub(crate) core: Option<usize>,
}

/// How long a process may be silent at least that computes without end. Chosen by hand: more than the longest cycle that a
/// machine's stall or an injected slowness makes, of some periods.
const COMPUTES: Duration = Duration::from_millis(10);
/// How long one at least that is stopped. Chosen by hand: it has missed a cycle, and nothing but somebody else's signal lets it do
/// another.
const STOPPED: Duration = Duration::from_millis(1);
/// How long one at least that sleeps while its core goes on. Chosen by hand: for two thirds of it it is seen not to have run at all, and
/// even one that skips a release sleeps for less than two periods.
const SLEEPS: Duration = Duration::from_millis(3);
/// They are killed after these parts of their limit. Chosen by hand: 10, 1 and 3 ms of the shipped table's 100. A table that is
/// patient, because somebody looks into its processes with a debugger, stays so.
const COMPUTES_PART: u32 = 10;
const STOPPED_PART: u32 = 100;
const SLEEPS_PART: u32 = 33;

/// How long a process with this limit may be silent that computes without end.
pub(crate) fn computes(limit: Duration) -> Duration {
    (limit / COMPUTES_PART).max(COMPUTES).min(limit)
}

/// How long one that is stopped.
pub(crate) fn stopped(limit: Duration) -> Duration {
    (limit / STOPPED_PART).max(STOPPED).min(limit)
}

/// How long one that sleeps while its core goes on.
pub(crate) fn sleeps(limit: Duration) -> Duration {
    (limit / SLEEPS_PART).max(SLEEPS).min(limit)
}

/// After which silence one is suspected to sleep for ever, whose limit this is. It is then seen not to run for the rest of the limit.
pub(crate) fn suspected(limit: Duration) -> Duration {
    sleeps(limit) / 3
}

/// Whether at least half of those that are watched on a core have lately sent pulses: then it runs what is due.
pub(crate) fn goes_on(core: Option<usize>, watched: &[Silence]) -> bool {
    let on_core = || watched.iter().filter(|silence| silence.core == core);
    let going_on = on_core().filter(|silence| silence.for_time < sleeps(silence.limit) / 2).count();
    2 * going_on >= on_core().count()
}

/// How long a process may be silent that is not real time, has not sent its first pulse yet, or is silent together with all
/// others: then the machine may be late. Chosen by hand.
pub(crate) const MACHINE_LATE: Duration = Duration::from_millis(500);

/// Whether all are silent together: their core stands still, or one of them keeps it from the others. That may begin between two of their pulses, so
/// one reaches its limit before the others reach theirs; who goes on has sent a pulse some ms ago.
pub(crate) fn all_silent(watched: &[Silence]) -> bool {
    watched.len() > 1 && watched.iter().all(|silence| silence.for_time > silence.limit / 2)
}

impl Silence {
    /// How long this process may be silent that `sleeps` though its core goes on, or does not, while `all_silent` are together or others
    /// go on.
    ///
    /// One that certainly hangs is not waited for, nor is one that sleeps though its core goes on. One that is silent while another one
    /// goes on, hangs. When all are silent together, that is waited for as long as machines are late.
    pub(crate) fn longest(&self, sleeps: bool, all_silent: bool) -> Duration {
        match (self.certain, self.is_steady && !all_silent) {
            (Some(limit), _) => limit,
            (None, true) if sleeps => self::sleeps(self.limit),
            (None, true) => self.limit,
            (None, false) => self.limit.max(MACHINE_LATE),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMIT: Duration = Duration::from_millis(10);

    /// The limit that each has exceeded, of those that hang; none of them sleeps.
    fn hung(watched: &[Silence]) -> Vec<Option<Duration>> {
        let all_silent = all_silent(watched);
        let exceeded = |silence: &Silence| {
            Some(silence.longest(false, all_silent)).filter(|limit| silence.for_time > *limit)
        };
        watched.iter().map(exceeded).collect()
    }

    fn silent(ms: u64) -> Silence {
        Silence {
            for_time: Duration::from_millis(ms),
            limit: LIMIT,
            is_steady: true,
            certain: None,
            core: None,
        }
    }

    #[test]
    fn one_that_is_silent_while_others_go_on_hangs() {
        assert_eq!(hung(&[silent(2), silent(11), silent(10)]), [None, Some(LIMIT), None]);
        assert_eq!(hung(&[silent(5), silent(11)]), [None, Some(LIMIT)]);
        assert_eq!(hung(&[silent(11), silent(11), silent(1)]), [Some(LIMIT), Some(LIMIT), None]);
    }

    #[test]
    fn when_all_are_silent_together_the_machine_gets_its_time() {
        assert_eq!(hung(&[silent(11), silent(400)]), [None, None]);
        assert_eq!(
            hung(&[silent(9), silent(11), silent(10)]),
            [None; 3],
            "one began to be silent before the others"
        );
        assert_eq!(hung(&[silent(501), silent(502)]), [Some(MACHINE_LATE), Some(MACHINE_LATE)]);
        assert_eq!(hung(&[silent(11)]), [Some(LIMIT)], "nobody to compare it with");
        assert_eq!(hung(&[]), []);
    }

    #[test]
    fn one_that_is_not_real_time_or_has_only_begun_gets_more_time() {
        let beginning = Silence { is_steady: false, ..silent(400) };
        assert_eq!(hung(&[silent(1), beginning]), [None, None]);
        let too_long = Silence { is_steady: false, ..silent(501) };
        assert_eq!(hung(&[silent(1), too_long]), [None, Some(MACHINE_LATE)]);
    }

    #[test]
    fn one_that_certainly_hangs_is_not_waited_for() {
        let limit = Duration::from_millis(100);
        let computing = |ms| Silence { limit, certain: Some(computes(limit)), ..silent(ms) };
        let waits = |ms| Silence { limit, ..silent(ms) };
        assert_eq!(hung(&[computing(10), computing(11), waits(99)]), [None, Some(COMPUTES), None]);
        assert_eq!(hung(&[computing(101), waits(101)]), [Some(COMPUTES), None], "though all are silent");
        let beginning = Silence { is_steady: false, ..computing(11) };
        assert_eq!(hung(&[beginning, waits(1)]), [Some(COMPUTES), None]);
        let stands = |ms| Silence { limit, certain: Some(stopped(limit)), ..silent(ms) };
        assert_eq!(hung(&[stands(1), stands(2), waits(99)]), [None, Some(STOPPED), None]);
    }

    #[test]
    fn one_that_sleeps_while_its_core_goes_on_sleeps_for_what_never_comes() {
        let limit = Duration::from_millis(100);
        let silent = Silence { limit, ..silent(11) };
        assert_eq!(silent.longest(true, false), limit / SLEEPS_PART);
        assert_eq!(silent.longest(false, false), limit, "it runs, or has no core");
        assert_eq!(silent.longest(true, true), MACHINE_LATE);
        assert_eq!(Silence { is_steady: false, ..silent }.longest(true, false), MACHINE_LATE);
    }

    #[test]
    fn a_core_goes_on_when_half_of_those_on_it_do() {
        let limit = Duration::from_millis(100);
        let on = |core, ms| Silence { limit, core: Some(core), ..silent(ms) };
        let core_goes_on = |watched: &[Silence]| goes_on(Some(1), watched);
        assert!(
            core_goes_on(&[on(1, 3), on(1, 1)]) && core_goes_on(&[on(1, 9), on(1, 9), on(1, 1), on(1, 1)])
        );
        assert!(!core_goes_on(&[on(1, 5), on(1, 5), on(1, 1)]));
        assert!(!core_goes_on(&[on(1, 5), on(1, 5), on(0, 1), on(0, 1)]), "another core does");
    }

    #[test]
    fn a_longer_limit_of_the_table_holds_always() {
        let limit = Duration::from_secs(2);
        let patient = |ms| Silence { limit, ..silent(ms) };
        assert_eq!(hung(&[patient(1900), patient(2001)]), [None, Some(limit)]);
        assert_eq!(hung(&[patient(2001), patient(2001)]), [Some(limit), Some(limit)]);
        let stands = |ms| Silence { certain: Some(stopped(limit)), ..patient(ms) };
        assert_eq!(hung(&[stands(19), stands(21)]), [None, Some(limit / STOPPED_PART)]);
        assert_eq!(computes(LIMIT / 2), LIMIT / 2, "certainty makes nobody more patient");
    }
}
