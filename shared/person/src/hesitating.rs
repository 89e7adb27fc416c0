//! A hand that stops in mid-reach, and goes on.

use crate::turning::is_plain;
use crate::{Hesitation, Person, PersonState, Surroundings};
use coact_period::cycles;
use coact_random::Stream;
use rand::RngExt;
use std::ops::RangeInclusive;
use std::time::Duration;

/// Fraction of its way at which a hand that hesitates stands. Chosen by hand, as is the time: before and after, nobody would see it.
const STANDS_AT: RangeInclusive<f64> = 0.25..=0.75;
/// How long it stands, cycles.
const STANDS: RangeInclusive<u64> = cycles(Duration::from_millis(300))..=cycles(Duration::from_secs(1));

impl Person {
    /// Hesitates in the present reach, if that is to be and has come to be due. What moves the hand only waits: it goes on as it would have.
    pub(crate) fn hesitate(&self, state: &mut PersonState, around: &Surroundings) {
        let hesitates = self.policy.behaviour().map_or(0.0, |behaviour| behaviour.hesitates);
        if hesitates <= 0.0 || !is_plain(state) {
            return;
        }
        let mut rng = self.random.at(Stream::Hesitation, state.movement.start);
        let (stops, from, stands) =
            (rng.random_bool(hesitates), rng.random_range(STANDS_AT), rng.random_range(STANDS));
        let then = self.covered(state, around.tick + Hesitation::STOPPING);
        if !stops || !(from..=*STANDS_AT.end()).contains(&then) {
            return;
        }
        state.hesitation = Hesitation { begun: around.tick.max(1), stands };
        state.movement.put_off(state.hesitation.delay());
        state.until = state.movement.end;
    }
}
