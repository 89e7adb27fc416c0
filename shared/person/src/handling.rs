//! From the reach to where the part is wanted: grasping, lifting, carrying and mounting.

use crate::person::error;
use crate::random_policy::notices_after;
use crate::{Activity, ActivityPhase, Holder, Manipulation, Person, PersonState, Policy, Surroundings};
use coact_messages::PartnerError;
use coact_period::cycles;
use coact_random::Stream;
use coact_recordings::WayKind;
use coact_stage_state::Slot;
use glam::DVec3;
use rand::RngExt;
use std::ops::Range;
use std::time::Duration;

// How long the person waits is chosen by hand: longer than the robot needs if all goes well, so that only a robot that
// does not come is given up.

/// How long the person waits at the socket for the robot to steady the base, cycles.
const STEADYING_PATIENCE: u64 = cycles(Duration::from_secs(3));
/// How long a part is shown to the robot for it to take, cycles.
const GIVING_PATIENCE: u64 = cycles(Duration::from_secs(15));
/// How long a part is held ready for its turn, cycles.
const TURN_PATIENCE: u64 = cycles(Duration::from_secs(15));
/// How long a gesture is shown, cycles.
const SHOWING_PATIENCE: u64 = cycles(Duration::from_secs(12));
/// How long the person waits for the robot to let go, cycles.
const RELEASE_PATIENCE: u64 = cycles(Duration::from_secs(10));
/// How long the closed fingers stay on the part before they lift it, cycles. Chosen by hand.
const DWELL: Range<u64> = cycles(Duration::from_millis(80))..cycles(Duration::from_millis(140));
/// How long mounting takes, cycles. Chosen by hand.
const MOUNTING: Range<u64> = cycles(Duration::from_millis(400))..cycles(Duration::from_millis(700));

/// How far above where it lay a part is held ready, m. Chosen by hand.
const HELD_READY: f64 = 0.08;
/// How long after grasp completion a part is put back, cycles. Chosen by hand: it is then hardly lifted, on its way, or at its socket.
const RETURNS: Range<u64> = cycles(Duration::from_millis(100))..cycles(Duration::from_millis(1500));

impl Person {
    pub(crate) fn reach(&self, state: &mut PersonState, around: &Surroundings, done: &mut Manipulation) {
        self.change_mind(state, around);
        self.hesitate(state, around);
        let before = state.hand;
        self.move_towards(state, around);
        self.see_heading(state, &before, around.tick);
        if state.phase() == ActivityPhase::Reach && state.movement.is_over(around.tick) {
            state.hand = state.movement.to;
            self.arrive(state, around, done);
        }
    }

    /// Moves the empty hand towards its goal, wherever that is now; gives up when the part cannot be had any more.
    pub(crate) fn move_towards(&self, state: &mut PersonState, around: &Surroundings) {
        if let Some(part) = state.part.get() {
            if !can_grasp(state.activity(), part, around) {
                return self.withdraw(state, around);
            }
            self.aim(state, around.parts.centre(part, around.task));
        }
        state.hand = self.reaching_pose(state, around.tick);
    }

    /// The fingers close on the part, or the gesture is fully shown.
    fn arrive(&self, state: &mut PersonState, around: &Surroundings, done: &mut Manipulation) {
        let tick = around.tick;
        self.see_mistake(state, around);
        state.grasped = tick;
        let Some(part) = state.part.get() else {
            return state.enter(ActivityPhase::Show, tick + SHOWING_PATIENCE);
        };
        state.held = Slot::of(part);
        if around.parts.is(part, Holder::Robot) {
            if state.gives_up == 0 {
                state.gives_up = self.withdraws(tick);
            }
            return state.enter(ActivityPhase::AwaitRelease, tick + RELEASE_PATIENCE);
        }
        done.grasped = Some(part);
        state.home = self.home_of(part, state.activity(), around).into();
        let pause = self.random.at(Stream::Movement, tick).random_range(DWELL);
        state.enter(ActivityPhase::Dwell, tick + pause);
    }

    /// Says when the activity will be given up: as it was meant to be, because the person will notice a mistake, or to put the part back.
    fn see_mistake(&self, state: &mut PersonState, around: &Surroundings) {
        let tick = around.tick;
        if error(state, around) == PartnerError::None {
            state.error = PartnerError::None;
        }
        let mistaken = self.policy.behaviour().is_some() && state.error != PartnerError::None;
        state.gives_up = match state.variation.gives_up_after {
            0 if mistaken => tick + notices_after(&mut self.random.at(Stream::Mistake, tick)),
            0 => self.returns(state, tick),
            after => tick + after,
        };
    }

    /// When the person will put back what was rightly taken from where it lay; 0: will not.
    fn returns(&self, state: &PersonState, tick: u64) -> u64 {
        let returns = self.policy.behaviour().map_or(0.0, |behaviour| behaviour.returns);
        let own = matches!(state.activity(), Activity::Insert | Activity::Give);
        if !own || state.error != PartnerError::None || returns <= 0.0 {
            return 0;
        }
        let mut rng = self.random.at(Stream::Return, tick);
        if rng.random_bool(returns) { tick + rng.random_range(RETURNS) } else { 0 }
    }

    /// Sets off with the grasped part to where it is wanted, or to be laid down; one whose turn is coming is held ready.
    pub(crate) fn lift(&self, state: &mut PersonState, around: &Surroundings) {
        if state.activity() == Activity::Undo {
            return self.take_back(state, around);
        }
        if state.activity() == Activity::Insert && (is_coming(state, around) || self.yields(state, around)) {
            let place = DVec3::from(state.home) + HELD_READY * DVec3::Z;
            self.carry_to(state, around, (place, DVec3::Z), WayKind::Carry);
            return state.enter(ActivityPhase::AwaitTurn, around.tick + TURN_PATIENCE);
        }
        match (state.activity(), state.subgoal.get()) {
            (Activity::Insert | Activity::Receive, Some(subgoal)) => {
                let goal = &around.task.subgoals[subgoal];
                let place = (goal.socket.into(), goal.axis.into());
                self.carry_to(state, around, place, WayKind::Carry);
            }
            _ => {
                let place = (around.task.scene.handover.into(), DVec3::Z);
                self.carry_to(state, around, place, WayKind::Give);
            }
        }
        state.enter(ActivityPhase::Carry, state.movement.end);
    }

    /// Whether the person lets the robot finish first that is at work beside where the part goes.
    fn yields(&self, state: &PersonState, around: &Surroundings) -> bool {
        matches!(self.policy, Policy::Active)
            && state.subgoal.get().is_some_and(|goal| around.robot_works_beside(goal))
    }

    /// Holds the part ready until its turn has come and the robot is out of the way, or for as long as patience lasts.
    pub(crate) fn await_turn(&self, state: &mut PersonState, around: &Surroundings, done: &mut Manipulation) {
        done.moved = self.carry(state, around);
        let goal = state.subgoal.get();
        let has_come = goal.is_some_and(|goal| around.parts.is_available(goal, around.task));
        if has_come && !self.yields(state, around) {
            self.lift(state, around);
        } else if around.tick >= state.until {
            self.take_back(state, around);
        }
    }

    pub(crate) fn carry_on(&self, state: &mut PersonState, around: &Surroundings, done: &mut Manipulation) {
        done.moved = self.carry(state, around);
        if !state.movement.is_over(around.tick) {
            return;
        }
        let needs_steadying =
            state.subgoal.get().is_some_and(|subgoal| around.task.subgoals[subgoal].steadied);
        match (state.phase(), state.activity()) {
            (ActivityPhase::Return, _) => self.put_down(state, around, done),
            (_, Activity::Give | Activity::Request) => {
                if state.gives_up == 0 {
                    state.gives_up = self.withdraws(around.tick);
                }
                state.enter(ActivityPhase::Give, around.tick + GIVING_PATIENCE);
            }
            _ if needs_steadying => {
                state.enter(ActivityPhase::AwaitSteadying, around.tick + STEADYING_PATIENCE);
            }
            _ => self.begin_mounting(state, around.tick),
        }
    }

    pub(crate) fn begin_mounting(&self, state: &mut PersonState, tick: u64) {
        let time = self.random.at(Stream::Movement, tick).random_range(MOUNTING);
        state.enter(ActivityPhase::Mount, tick + time);
    }
}

/// Whether the turn of the present activity's step is coming.
fn is_coming(state: &PersonState, around: &Surroundings) -> bool {
    state.subgoal.get().is_some_and(|goal| around.is_coming(goal))
}

/// Whether the part is still where the activity needs it: free to be taken, mounted to be taken out, or in the robot's hand to be handed
/// over.
fn can_grasp(activity: Activity, part: usize, around: &Surroundings) -> bool {
    match activity {
        Activity::Receive => around.robot.held == Some(part),
        Activity::Undo => around.parts.is(part, Holder::Socket),
        _ => around.parts.is(part, Holder::Nobody),
    }
}
