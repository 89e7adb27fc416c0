//! The stages in which the person waits for the robot.

use super::PersonMemory;
use super::actor::{Person, Surroundings};
use crate::noise::Stream;
use crate::parts::Holder;
use crate::slot::Slot;
use rand::RngExt;

/// How long it takes to feel that the robot has gripped, or let go, ms.
const FELT_MS: u64 = 200;
/// By how much a person who comes late does so, ms.
const LATE_MS: std::ops::RangeInclusive<u64> = 2000..=6000;
/// How soon a person who withdraws does so, ms.
const WITHDRAWS_MS: std::ops::RangeInclusive<u64> = 50..=600;

impl Person {
    /// Holds the part out until the robot has it, or for as long as patience lasts.
    pub(super) fn offer(&self, memory: &mut PersonMemory, around: &mut Surroundings) {
        let gripped = memory.grip.get().is_some() && around.robot.held == memory.grip;
        if self.felt(gripped, memory, around.tick) {
            self.put_down(memory, around);
        } else if !gripped && around.tick >= memory.until {
            self.take_back(memory, around);
        }
    }

    /// Keeps the gesture up until the robot offers what is needed, or for as long as patience lasts.
    pub(super) fn show(&self, memory: &mut PersonMemory, around: &mut Surroundings) {
        if let Some(taking) = around.view().take_offered().filter(|_| !self.comes_late(around)) {
            self.take_up(taking, memory, around);
        } else if around.tick >= memory.until {
            self.withdraw(memory, around);
        }
    }

    /// Has the fingers on the robot's part, and takes it as soon as the robot lets go.
    pub(super) fn await_release(&self, memory: &mut PersonMemory, around: &mut Surroundings) {
        let released = around.robot.held != memory.grip;
        if released && let Some(part) = memory.grip.get() {
            around.parts.give_to(part, Holder::Person);
            memory.home = around.parts.position(part).into();
        }
        if self.felt(released, memory, around.tick) {
            memory.gives_up = 0;
            self.lift(memory, around);
        } else if !released && around.tick >= memory.until {
            memory.grip = Slot::EMPTY;
            self.withdraw(memory, around);
        }
    }

    /// Whether the person has not come yet for what the robot offers, for being late this time.
    pub(super) fn comes_late(&self, around: &Surroundings) -> bool {
        let (Some(rates), since) = (self.plan.rates(), around.robot.offering_since) else { return false };
        let mut rng = self.noise.at(Stream::Handover, since);
        let late = since > 0 && rng.random_bool(rates.late);
        late && around.tick < since + rng.random_range(LATE_MS)
    }

    /// When the person will let go of a part that the robot has as well, or take one back that is held out; 0: will not.
    pub(super) fn withdraws(&self, tick: u64) -> u64 {
        let mut rng = self.noise.at(Stream::Handover, tick);
        let share = self.plan.rates().map_or(0.0, |rates| rates.withdraws);
        if rng.random_bool(share) { tick + rng.random_range(WITHDRAWS_MS) } else { 0 }
    }

    /// Whether `happening` has gone on long enough to be felt.
    fn felt(&self, happening: bool, memory: &mut PersonMemory, tick: u64) -> bool {
        memory.felt = match (happening, memory.felt) {
            (false, _) => 0,
            (true, 0) => tick.max(1),
            (true, since) => since,
        };
        memory.felt > 0 && tick >= memory.felt + FELT_MS
    }
}
