//! At rest: what to do next, and what it will be like.

use crate::person::error;
use crate::{
    ActivityPhase, Hesitation, Intention, Person, PersonState, ReachTurn, Surroundings, Undertaking,
};
use bytemuck::Zeroable;
use coact_random::Stream;
use coact_stage_state::Slot;
use rand::RngExt;

impl Person {
    /// Thinks about what to do next.
    pub(crate) fn decide(&self, state: &mut PersonState, around: &Surroundings) {
        let mut rng = self.random.at(Stream::Choice, around.tick);
        let now = *state;
        let can_hide = |intention: &Intention| {
            let mut imagined = now;
            self.intend(*intention, &mut imagined, around);
            imagined.occluder().is_some()
        };
        if self.comes_late(around) {
            state.until = around.tick + 1;
            return;
        }
        match self.policy.next(around, state, &can_hide, &mut rng) {
            Undertaking::Rest(pause) => state.until = around.tick + pause.max(1),
            Undertaking::Begin(intention) => self.take_up(intention, state, around),
        }
    }

    /// Makes an intention the present activity.
    pub(crate) fn take_up(&self, intention: Intention, state: &mut PersonState, around: &Surroundings) {
        self.intend(intention, state, around);
        state.enter(ActivityPhase::Prepare, state.movement.onset);
    }

    /// What the activity will be like: how the hand will reach, and what stands in the way of the robot's sight.
    fn intend(&self, intention: Intention, state: &mut PersonState, around: &Surroundings) {
        self.mean(intention, state, around);
        state.turn = ReachTurn::zeroed();
        state.hesitation = Hesitation::default();
        state.movement = self.reach_movement(state, around);
        state.set_occluder(self.occluder(state, around));
    }

    /// What the activity is from now on: its meaning, and whose recorded hand shows it.
    pub(crate) fn mean(&self, intention: Intention, state: &mut PersonState, around: &Surroundings) {
        state.chain = Slot::of(intention.chain);
        state.subgoal = intention.subgoal.map_or(Slot::EMPTY, Slot::of);
        state.part = intention.part.map_or(Slot::EMPTY, Slot::of);
        state.activity = intention.activity;
        state.variation = intention.variation;
        state.recording = self.choose_recording(intention, around);
    }

    /// One of the recorded reaches for a part of this width.
    fn choose_recording(&self, intention: Intention, around: &Surroundings) -> Slot {
        let (Some(recorded), Some(part)) = (&self.recorded, intention.part) else { return Slot::EMPTY };
        let width = around.task.kinds[around.parts.kind(part)].width;
        let turn =
            self.random.at(Stream::Choice, around.tick).random_range(0..recorded.count_for(width).max(1));
        recorded.nth_for(width, turn).map_or(Slot::EMPTY, Slot::of)
    }

    /// Reach onset: an activity begins.
    pub(crate) fn set_out(&self, state: &mut PersonState, around: &Surroundings) {
        state.actions += 1;
        state.onset = around.tick;
        state.grasped = 0;
        state.gives_up = 0;
        state.error = error(state, around);
        if state.variation.phrase != Slot::EMPTY {
            state.to_say = state.variation.phrase;
        }
        state.enter(ActivityPhase::Reach, state.movement.end);
        self.move_towards(state, around);
    }
}
