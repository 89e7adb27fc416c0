//! At rest: what to do next, and what it will be like.

use crate::person::error;
use crate::{
    Activity, ActivityPhase, Hesitation, Intention, Person, PersonState, ReachTurn, Surroundings,
    Undertaking, Variation,
};
use bytemuck::Zeroable;
use coact_messages::ArmSide;
use coact_random::Stream;
use coact_stage_state::{Flag, Slot};
use rand::RngExt;

/// What is nearer to the wrist of a resting hand lies under the hand, m. Chosen by hand: a hand's length.
const UNDER_HAND: f64 = 0.20;

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
        let next = self.policy.next(around, state, &can_hide, &mut rng);
        state.awaits_robot = Flag::from(matches!(next, Undertaking::Await(_)));
        match next {
            Undertaking::Rest(pause) | Undertaking::Await(pause) => state.until = around.tick + pause.max(1),
            Undertaking::Begin(intention) => {
                self.take_up(self.with_either_hand(intention, around), state, around)
            }
        }
    }

    /// The same intention with the hand that this person takes for it: at times the left one takes what lies nearer to it, but does not
    /// lie under it. Either one asks for a part, or takes it from the robot.
    fn with_either_hand(&self, intention: Intention, around: &Surroundings) -> Intention {
        let share = self.policy.behaviour().map_or(0.0, |behaviour| behaviour.left);
        let may = share > 0.0 && self.suits_the_left(intention, around);
        if !may || !self.random.at(Stream::Side, around.tick).random_bool(share) {
            return intention;
        }
        Intention { variation: Variation { left: Flag::Set, ..intention.variation }, ..intention }
    }

    /// Whether what is wanted does not lie nearer to the right hand.
    fn suits_the_left(&self, intention: Intention, around: &Surroundings) -> bool {
        let lies = intention.part.filter(|_| intention.activity != Activity::Receive);
        let Some(part) = lies else { return true };
        let place = around.parts.centre(part, around.task);
        let [right, left] = ArmSide::BOTH.map(|side| self.arms[side as usize].away_from_rest(place));
        (UNDER_HAND..right).contains(&left)
    }

    /// Makes an intention the present activity.
    pub(crate) fn take_up(&self, intention: Intention, state: &mut PersonState, around: &Surroundings) {
        self.intend(intention, state, around);
        state.enter(ActivityPhase::Prepare, state.movement.onset);
    }

    /// What the activity will be like: how the hand will reach, and what stands in the way of the robot's sight.
    fn intend(&self, intention: Intention, state: &mut PersonState, around: &Surroundings) {
        self.mean(intention, state, around);
        let side = if state.variation.left.is_set() { ArmSide::Left } else { ArmSide::Right };
        if state.side != side {
            state.side = side;
            state.hand = self.arm(state).rest();
        }
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
