//! The period of one cycle, and nothing else.
//!
//! The period is fixed at 1 kHz by design: every stage advances by exactly one period at each step, and the network's
//! time constants, the servo's limits and perception's filters are computed for it. So it is a constant, not a setting,
//! and this crate is the only place where its length stands. Durations are written as durations and become cycles here:
//!
//! ```
//! use coact_period::{PERIOD, cycles, seconds};
//! use std::time::Duration;
//!
//! const PATIENCE: u64 = cycles(Duration::from_millis(120));
//! assert_eq!(PATIENCE, 120);
//! assert_eq!(seconds(PATIENCE), 0.12);
//! assert_eq!(PERIOD, Duration::from_millis(1));
//! ```

use std::time::Duration;

/// Length of one cycle.
pub const PERIOD: Duration = Duration::from_millis(1);

/// The same in nanoseconds, as message stamps count.
pub const PERIOD_NS: u64 = PERIOD.as_nanos() as u64;

/// The same in seconds, as the equations of motion and of the fields take it.
///
/// Written out: a conversion from nanoseconds would have to be exact to the last bit.
pub const PERIOD_S: f64 = 1e-3;

/// Cycles in one second.
pub const CYCLES_PER_SECOND: u64 = 1_000_000_000 / PERIOD_NS;

/// How many cycles a duration lasts.
///
/// # Panics
/// When it is no whole number of cycles. In a constant, that is an error of compilation.
pub const fn cycles(duration: Duration) -> u64 {
    assert!(
        duration.as_nanos().is_multiple_of(PERIOD_NS as u128),
        "a duration in cycles must be a whole number of them"
    );
    (duration.as_nanos() / PERIOD_NS as u128) as u64
}

/// How long so many cycles last, s.
pub const fn seconds(cycles: u64) -> f64 {
    cycles as f64 * PERIOD_S
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_period_is_the_same_in_all_units() {
        assert_eq!(PERIOD.as_secs_f64(), PERIOD_S);
        assert_eq!(Duration::from_nanos(PERIOD_NS), PERIOD);
        assert_eq!(PERIOD * CYCLES_PER_SECOND as u32, Duration::from_secs(1));
    }

    #[test]
    #[should_panic(expected = "whole number")]
    fn a_duration_between_two_cycles_is_refused() {
        cycles(Duration::from_micros(1500));
    }
}
