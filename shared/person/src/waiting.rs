//! The phases in which the person waits for the robot.

use crate::{Intention, Manipulation, Person, PersonState, Surroundings, Variation};
use coact_period::cycles;
use coact_random::Stream;
use coact_stage_state::Slot;
use rand::RngExt;
use std::ops::RangeInclusive;
use std::time::Duration;

/// How long it takes to feel that the robot has gripped, or let go, cycles: of the size of a reaction to touch.
const FELT: u64 = cycles(Duration::from_millis(200));
/// By how much a person who comes late does so, cycles. Chosen by hand, as is the next one.
const LATE: RangeInclusive<u64> = cycles(Duration::from_secs(2))..=cycles(Duration::from_secs(6));
/// How soon a person who withdraws does so, cycles.
const WITHDRAWS: RangeInclusive<u64> = cycles(Duration::from_millis(50))..=cycles(Duration::from_millis(600));

impl Person {
    /// Shows the part until the robot has it, or for as long as patience lasts.
    pub(crate) fn give(&self, state: &mut PersonState, around: &Surroundings, done: &mut Manipulation) {
        let gripped = state.held.get().is_some() && around.robot.held == state.held.get();
        if self.felt(gripped, state, around.tick) {
            self.put_down(state, around, done);
        } else if !gripped && around.tick >= state.until {
            self.take_back(state, around);
        }
    }

    /// Keeps the gesture up until the robot gives what is needed, or for as long as patience lasts.
    pub(crate) fn show(&self, state: &mut PersonState, around: &Surroundings) {
        if let Some(receiving) = around.receive().filter(|_| !self.comes_late(around)) {
            let variation = Variation { left: state.variation.left, ..receiving.variation };
            self.take_up(Intention { variation, ..receiving }, state, around);
        } else if around.tick >= state.until {
            self.withdraw(state, around);
        }
    }

    /// Has the fingers on the robot's part, and takes it as soon as the robot lets go.
    pub(crate) fn await_release(
        &self,
        state: &mut PersonState,
        around: &Surroundings,
        done: &mut Manipulation,
    ) {
        let released = around.robot.held != state.held.get();
        if released && let Some(part) = state.held.get() {
            done.grasped = Some(part);
            state.home = around.parts.position(part).into();
        }
        if self.felt(released, state, around.tick) {
            state.gives_up = 0;
            self.lift(state, around);
        } else if !released && around.tick >= state.until {
            state.held = Slot::EMPTY;
            self.withdraw(state, around);
        }
    }

    /// Whether the person has not come yet for what the robot gives, for being late this time.
    pub(crate) fn comes_late(&self, around: &Surroundings) -> bool {
        let (Some(behaviour), since) = (self.policy.behaviour(), around.robot.giving_since) else {
            return false;
        };
        let mut rng = self.random.at(Stream::Handover, since);
        let late = since > 0 && rng.random_bool(behaviour.late);
        late && around.tick < since + rng.random_range(LATE)
    }

    /// When the person will let go of a part that the robot has as well, or take one back that is given; 0: will not.
    pub(crate) fn withdraws(&self, tick: u64) -> u64 {
        let mut rng = self.random.at(Stream::Handover, tick);
        let fraction = self.policy.behaviour().map_or(0.0, |behaviour| behaviour.withdraws);
        if rng.random_bool(fraction) { tick + rng.random_range(WITHDRAWS) } else { 0 }
    }

    /// Whether `happening` has gone on long enough to be felt.
    fn felt(&self, happening: bool, state: &mut PersonState, tick: u64) -> bool {
        state.felt_since = match (happening, state.felt_since) {
            (false, _) => 0,
            (true, 0) => tick.max(1),
            (true, since) => since,
        };
        state.felt_since > 0 && tick >= state.felt_since + FELT
    }
}
