//! The stages in which the person waits for the robot.

use super::PersonMemory;
use super::actor::{Person, Surroundings};
use crate::parts::Holder;
use crate::slot::Slot;

/// How long it takes to feel that the robot has gripped, or let go, ms.
const FELT_MS: u64 = 200;

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
        if let Some(taking) = around.view().take_offered() {
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
            self.lift(memory, around);
        } else if !released && around.tick >= memory.until {
            memory.grip = Slot::EMPTY;
            self.withdraw(memory, around);
        }
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
