use coact_period::{PERIOD_NS, cycles};
use std::fmt;
use std::str::FromStr;
use std::time::Duration;

/// How long the answers of a planner that works within the step are held back. A planner beside the servo takes its time, in which
/// the arm stands, or goes on where it went.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PlannerDelay {
    /// Not at all.
    #[default]
    None,
    /// Each search for so long.
    Fixed(Duration),
    /// Each for as long as it has computed: as in real time on this machine, and on none quite the same twice.
    Measured,
}

/// A delay that is none.
#[derive(Debug, thiserror::Error, PartialEq, Eq)]
#[error("{0:?} is no delay of a planner; expected measured, or a number of ms from 0 to 60000")]
pub struct UnknownDelay(String);

/// The longest delay, ms: a search is given up long before.
const MOST_MS: u64 = 60_000;

impl PlannerDelay {
    /// For how many cycles the answer of a search that has computed for so long is held back.
    pub(crate) fn of(self, computed_ns: u64) -> u64 {
        match self {
            Self::None => 0,
            Self::Fixed(delay) => cycles(delay),
            Self::Measured => computed_ns.div_ceil(PERIOD_NS),
        }
    }
}

impl fmt::Display for PlannerDelay {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => f.write_str("none"),
            Self::Fixed(delay) => write!(f, "{} ms", delay.as_millis()),
            Self::Measured => f.write_str("measured"),
        }
    }
}

impl FromStr for PlannerDelay {
    type Err = UnknownDelay;

    fn from_str(text: &str) -> Result<Self, UnknownDelay> {
        if text == "measured" {
            return Ok(Self::Measured);
        }
        let ms = text.parse().ok().filter(|ms| *ms <= MOST_MS);
        ms.map(|ms| Self::Fixed(Duration::from_millis(ms))).ok_or_else(|| UnknownDelay(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delays_are_measured_or_a_number_of_ms() {
        assert_eq!("measured".parse(), Ok(PlannerDelay::Measured));
        assert_eq!("25".parse(), Ok(PlannerDelay::Fixed(Duration::from_millis(25))));
        for text in ["", "soon", "-1", "1.5", "60001"] {
            assert_eq!(text.parse::<PlannerDelay>(), Err(UnknownDelay(text.to_owned())));
        }
    }

    #[test]
    fn a_measured_answer_is_there_in_the_cycle_after_the_search_ends() {
        assert_eq!([0, 1, PERIOD_NS, PERIOD_NS + 1].map(|ns| PlannerDelay::Measured.of(ns)), [0, 1, 1, 2]);
        assert_eq!(PlannerDelay::None.of(7 * PERIOD_NS), 0);
        assert_eq!(PlannerDelay::Fixed(Duration::from_millis(25)).of(0), 25);
    }
}
