//! What a hand that comes from outside does to the parts: by its fingers alone.

use crate::fingers::Fingers;
use crate::{
    ActivityPhase, FINGERS, Holder, Intention, Manipulation, Person, PersonState, Policy, Surroundings,
};
use coact_stage_state::Slot;
use glam::DVec3;

/// Fingers have closed on a part when they are no further apart than its width, their own thickness and this, m. A person's tracked
/// fingers scatter by some millimetres. Chosen by hand, as are all distances here.
const TOUCHING: f64 = 0.004;
/// They have let go of it when they are further apart than that by this, m.
const OPENED: f64 = 0.012;
/// A part is between open fingers when their middle is this near to its axis, m ...
const AROUND: f64 = 0.06;
/// ... and fingers that close have it when their middle is this near, m: half the width of a large part.
const AT_PART: f64 = 0.035;
/// A hand that is faster than this closes on nothing that it passes, m/s: people's reaches are far slower when they arrive.
const PASSES: f64 = 0.3;
/// A part that the robot has, too, and that is farther from the fingers than this, is not between them any more, m.
const LOST: f64 = 0.10;
/// Thumb to index of a hand that is held out open, m.
const HELD_OUT: f64 = 0.07;
/// How near to where parts change hands a hand is held out, and beyond which it is not any more, m.
const AT_HANDOVER: (f64, f64) = (0.20, 0.30);
/// A part at its socket is this near to it, m.
const AT_SOCKET: f64 = 0.05;
/// Fingers that have opened are on their way back until they are so far from where they did, m.
const WITHDRAWN: f64 = 0.10;

impl Person {
    /// The hand is there, in the order of [`KeypointName`](coact_messages::KeypointName), m: told from outside. A person whose hand does
    /// not come from there does not care.
    pub fn show_hand(&self, state: &mut PersonState, tick: u64, points: &[[f64; 3]; 9]) {
        if matches!(self.policy, Policy::Live) {
            state.live.show(tick, points);
        }
    }

    /// Whether nobody knows where the person is: the hand comes from outside, and nobody tells of it.
    pub fn is_unknown(&self, state: &PersonState, tick: u64) -> bool {
        matches!(self.policy, Policy::Live) && !state.live.is_seen(tick)
    }

    /// One tick of a hand that comes from outside. While nobody tells of it, what it holds stays where it is.
    pub(crate) fn follow(&self, state: &mut PersonState, around: &Surroundings) -> Manipulation {
        let mut done = Manipulation::default();
        if !state.live.is_seen(around.tick) {
            if state.held == Slot::EMPTY {
                turn_to(ActivityPhase::Rest, state, around);
            }
            (state.contact_since, state.force) = (0, [0.0; 3]);
            return done;
        }
        let points = state.live.at(around.tick);
        let fingers = Fingers::of(&points);
        state.hand = self.arm(state).pose_of(&points);
        state.live.follow(around.tick, state.hand.wrist());
        match state.held.get() {
            None => self.reach_out(state, around, &fingers, &mut done),
            Some(part) => self.have(part, state, around, &fingers, &mut done),
        }
        self.exert(state, around);
        done
    }

    /// The empty hand: it may close on a part, or be held out.
    fn reach_out(
        &self,
        state: &mut PersonState,
        around: &Surroundings,
        fingers: &Fingers,
        done: &mut Manipulation,
    ) {
        let near = around.graspable(fingers.middle);
        let closes = near.filter(|&part| {
            let closed = fingers.aperture <= around.closed_on(part) + TOUCHING;
            let was_between = state.between.get() == Some(part);
            state.between = if closed { state.between } else { Slot::of(part) };
            let arrives = state.live.speed(state.hand.wrist()) < PASSES;
            closed && was_between && arrives && around.distance(part, fingers.middle) <= AT_PART
        });
        if let Some(part) = closes {
            return close_on(part, state, around, fingers, done);
        }
        if near.is_none() {
            state.between = Slot::EMPTY;
            if state.phase() != ActivityPhase::Show
                && let Some(asked) = request(state, around, fingers)
            {
                begin(state, around, asked);
                state.ended = around.tick;
                return turn_to(ActivityPhase::Show, state, around);
            }
        }
        turn_to(empty_phase(state, around, fingers, near.is_some()), state, around);
    }

    /// The hand that has a part, alone or together with the robot.
    fn have(
        &self,
        part: usize,
        state: &mut PersonState,
        around: &Surroundings,
        fingers: &Fingers,
        done: &mut Manipulation,
    ) {
        let robot_has_it = around.robot.held == Some(part);
        let opens = fingers.aperture > around.closed_on(part) + OPENED;
        // A hand that nobody told of for a while may come back far from where it was, closed on what it had.
        let has_left = robot_has_it && around.distance(part, fingers.middle) > LOST;
        if opens || has_left || around.parts.is(part, Holder::Socket) {
            done.released = Some(part).filter(|&part| !around.parts.is(part, Holder::Socket));
            state.held = Slot::EMPTY;
            (state.ended, state.live.opened_at) = (around.tick, fingers.middle.into());
            return turn_to(ActivityPhase::Withdraw, state, around);
        }
        if !robot_has_it {
            if !around.parts.is(part, Holder::Person) {
                done.grasped = Some(part);
            }
            done.moved = Some(self.carry_along(part, state, around, fingers.middle));
        }
        turn_to(full_phase(part, state, around), state, around);
    }
}

/// The fingers have closed on a part: an action counts from when the hand set out for it.
fn close_on(
    part: usize,
    state: &mut PersonState,
    around: &Surroundings,
    fingers: &Fingers,
    done: &mut Manipulation,
) {
    if let Some(meant) = around.meaning_of_grasp(part, fingers.pitch) {
        begin(state, around, meant);
    }
    (state.held, state.between) = (Slot::of(part), Slot::EMPTY);
    state.home = around.parts.position(part).into();
    state.offset = (around.parts.centre(part, around.task) - fingers.middle).into();
    let turn = around.parts.orientation(part).into();
    (state.turn_from, state.turn_to) = (turn, turn);
    if around.parts.is(part, Holder::Robot) {
        return turn_to(ActivityPhase::AwaitRelease, state, around);
    }
    done.grasped = Some(part);
    turn_to(ActivityPhase::Dwell, state, around);
}

/// An action is told now that it is complete: it began when the hand set out, or when the one before was over.
fn begin(state: &mut PersonState, around: &Surroundings, meant: Intention) {
    state.actions += 1;
    state.activity = meant.activity;
    state.chain = Slot::of(meant.chain);
    state.subgoal = meant.subgoal.into();
    state.part = meant.part.into();
    state.error = around.error_of(&meant);
    state.onset = state.live.onset.max(state.ended);
    state.grasped = around.tick;
}

fn turn_to(phase: ActivityPhase, state: &mut PersonState, around: &Surroundings) {
    if state.phase() == phase {
        return;
    }
    if matches!(phase, ActivityPhase::Reach | ActivityPhase::Rest) {
        // Nobody knows what it will be.
        (state.chain, state.subgoal, state.part) = (Slot::EMPTY, Slot::EMPTY, Slot::EMPTY);
    }
    state.enter(phase, around.tick);
}

/// What the empty hand asks for that is held still: by a finger that points, or by an open hand.
fn request(state: &PersonState, around: &Surroundings, fingers: &Fingers) -> Option<Intention> {
    if state.live.moves() {
        return None;
    }
    match fingers.points {
        Some(finger) => around.meaning_of_pointing(finger),
        None if is_held_out(around, fingers) => around.meaning_of_gesture(fingers.pitch),
        None => None,
    }
}

/// Whether the open hand is held out where parts change hands, and nothing is there to be taken.
fn is_held_out(around: &Surroundings, fingers: &Fingers) -> bool {
    let away = fingers.middle.distance(around.task.scene.handover.into());
    fingers.aperture > HELD_OUT && away < AT_HANDOVER.0 && around.robot.giving_since == 0
}

/// What the empty hand is doing.
fn empty_phase(
    state: &PersonState,
    around: &Surroundings,
    fingers: &Fingers,
    at_part: bool,
) -> ActivityPhase {
    let away = |place: [f64; 3]| fingers.middle.distance(place.into());
    match state.phase() {
        ActivityPhase::Show
            if fingers.points.is_some() || away(around.task.scene.handover) < AT_HANDOVER.1 =>
        {
            ActivityPhase::Show
        }
        ActivityPhase::Withdraw if state.live.moves() || away(state.live.opened_at) < WITHDRAWN => {
            ActivityPhase::Withdraw
        }
        ActivityPhase::Reach if at_part => ActivityPhase::Reach,
        _ if state.live.moves() => ActivityPhase::Reach,
        _ => ActivityPhase::Rest,
    }
}

/// What the hand is doing with the part that it has.
fn full_phase(part: usize, state: &PersonState, around: &Surroundings) -> ActivityPhase {
    let place = around.parts.position(part);
    let socket = around.open_socket(part).filter(|&goal| {
        place.distance(around.task.subgoals[goal].socket.into()) < AT_SOCKET && !state.live.moves()
    });
    let away = |from: [f64; 3]| place.distance(DVec3::from(from));
    match (state.phase(), socket) {
        (ActivityPhase::AwaitRelease, _) if around.robot.held == Some(part) => ActivityPhase::AwaitRelease,
        (_, _) if around.robot.held == Some(part) => ActivityPhase::Give,
        (_, Some(goal)) if around.task.subgoals[goal].steadied && around.robot.steadying_since == 0 => {
            ActivityPhase::AwaitSteadying
        }
        (_, Some(_)) => ActivityPhase::Mount,
        (ActivityPhase::Dwell, None) if away(state.home) < TOUCHING => ActivityPhase::Dwell,
        _ if away(around.task.scene.handover) < AT_HANDOVER.0 && !state.live.moves() => ActivityPhase::Give,
        _ => ActivityPhase::Carry,
    }
}

impl Surroundings<'_> {
    /// The part nearest to `place` that fingers there could close on.
    fn graspable(&self, place: DVec3) -> Option<usize> {
        let free = |part: &usize| self.parts.is(*part, Holder::Nobody) || self.parts.is(*part, Holder::Robot);
        (0..self.task.parts.len())
            .filter(|part| free(part) && self.distance(*part, place) <= AROUND)
            .min_by(|one, other| self.distance(*one, place).total_cmp(&self.distance(*other, place)))
    }

    fn distance(&self, part: usize, place: DVec3) -> f64 {
        self.parts.distance_to_axis(part, place, self.task)
    }

    /// Thumb to index around a part, m.
    fn closed_on(&self, part: usize) -> f64 {
        self.task.kinds[self.parts.kind(part)].width + FINGERS
    }
}
