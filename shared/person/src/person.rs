use crate::habits::OwnHabits;
use crate::{
    ActivityPhase, Habits, HandModel, Manipulation, PersonState, Policy, RecordedReaches, RecordedWays,
    Surroundings, random_policy,
};
use coact_joint_task::{Scene, Task};
use coact_messages::{ArmSide, PartnerError};
use coact_random::{RandomStreams, Stream};
use coact_recordings::WayKind;
use coact_stage_state::{Implausible, Slot};
use glam::DVec3;

/// The human partner: carries out one intention after the other, phase by phase.
#[derive(Debug, Clone)]
pub struct Person {
    /// By [`ArmSide`].
    pub(crate) arms: [HandModel; 2],
    pub(crate) policy: Policy,
    pub(crate) random: RandomStreams,
    pub(crate) habits: OwnHabits,
    /// Recorded reaches that drive the hand in place of the model's profiles.
    pub(crate) recorded: Option<RecordedReaches>,
    /// Recorded ways along which the hand goes otherwise, in place of straight ones.
    pub(crate) ways: Option<RecordedWays>,
}

impl Person {
    /// A person who sits at `scene` and has some of people's `habits`; reaches are `recorded` ones, or else the model's.
    pub fn new(
        scene: &Scene,
        habits: &Habits,
        policy: Policy,
        random: RandomStreams,
        recorded: Option<RecordedReaches>,
    ) -> Self {
        let habits = habits.draw(&random);
        let arms = ArmSide::BOTH.map(|side| HandModel::of(scene, side));
        Self { arms, habits, policy, random, recorded, ways: None }
    }

    /// The same person, who carries, gives and withdraws along `ways`, if there are any.
    pub fn with_ways(self, ways: Option<RecordedWays>) -> Self {
        Self { ways, ..self }
    }

    /// The person at the start of a run: both hands at rest.
    pub fn start(&self, tick: u64, state: &mut PersonState) {
        state.side = match &self.policy {
            Policy::Arm(arm) => arm.side(),
            _ => ArmSide::Right,
        };
        state.hand = self.arm(state).rest();
        state.enter(ActivityPhase::Rest, tick + self.policy.pause(&self.random, tick));
        state.ended = tick;
    }

    /// Refuses a state that this person cannot be in at tick `now`: a damaged one, or one of another task.
    ///
    /// # Errors
    /// The field that is not what it can be.
    pub fn check(&self, state: &PersonState, task: &Task, now: u64) -> Result<(), Implausible> {
        let recordings = self.recorded.as_ref().map_or(0, |recorded| recorded.reaches.len());
        let ways = self.ways.as_ref().map_or(0, |own| own.ways.len());
        state.check(task, (recordings, ways), now)
    }

    /// One tick: moves the hand, and what it holds, and goes on to the next phase when the present one is over.
    pub fn advance(&self, state: &mut PersonState, around: &Surroundings) -> Manipulation {
        if matches!(self.policy, Policy::Live) {
            return self.follow(state, around);
        }
        let mut done = Manipulation::default();
        if state.gives_up > 0 && around.tick >= state.gives_up {
            self.give_up(state, around, &mut done);
        }
        let over = around.tick >= state.until;
        match state.phase() {
            ActivityPhase::Rest if over => self.decide(state, around),
            ActivityPhase::Rest => {}
            ActivityPhase::Prepare if over => self.set_out(state, around),
            ActivityPhase::Prepare => self.move_towards(state, around),
            ActivityPhase::Reach => self.reach(state, around, &mut done),
            ActivityPhase::Dwell if over => self.lift(state, around),
            ActivityPhase::Dwell => {}
            ActivityPhase::Carry | ActivityPhase::Return => self.carry_on(state, around, &mut done),
            ActivityPhase::AwaitTurn => self.await_turn(state, around, &mut done),
            ActivityPhase::AwaitSteadying if over || around.robot.steadying_since > 0 => {
                self.begin_mounting(state, around.tick)
            }
            ActivityPhase::AwaitSteadying => {}
            // What is to be given up is not mounted.
            ActivityPhase::Mount if over && state.gives_up == 0 => self.put_down(state, around, &mut done),
            ActivityPhase::Mount => {}
            ActivityPhase::Give => self.give(state, around, &mut done),
            ActivityPhase::Show => self.show(state, around),
            ActivityPhase::AwaitRelease => self.await_release(state, around, &mut done),
            ActivityPhase::Withdraw => self.withdrawing(state, around),
        }
        self.exert(state, around);
        done
    }

    /// The sentence that the person says now: the script's, or the phrase that goes with the present activity.
    pub fn speak<'a>(&'a self, state: &mut PersonState, task: &'a Task) -> Option<&'a str> {
        let index = std::mem::take(&mut state.to_say).get()?;
        match &self.policy {
            Policy::Script(script) => script.sentence(index),
            Policy::Random(_) => task.chains.get(state.chain.get()?)?.says.get(index).map(String::as_str),
            Policy::Synthetic | Policy::Active | Policy::Arm(_) | Policy::Live => None,
        }
    }

    /// The keypoints of the acting arm and hand at `tick`, in the order of [`KeypointName`](coact_messages::KeypointName), m.
    pub fn keypoints(&self, state: &PersonState, tick: u64) -> [DVec3; 9] {
        match &self.policy {
            Policy::Arm(arm) => arm.keypoints(tick),
            Policy::Live => state.live.at(tick),
            _ => self.arm(state).keypoints(&state.hand),
        }
    }

    /// Those of the other arm, whose hand rests. Beside a recorded arm it hangs down: that person stands.
    pub fn resting_keypoints(&self, state: &PersonState, tick: u64) -> [DVec3; 9] {
        let other = &self.arms[state.side.other() as usize];
        match &self.policy {
            Policy::Arm(arm) => arm.other_arm(tick),
            _ => other.keypoints(&other.rest()),
        }
    }

    /// The arm that acts.
    pub(crate) fn arm(&self, state: &PersonState) -> &HandModel {
        &self.arms[state.side as usize]
    }

    /// The middle between the finger tips, m.
    pub fn hand_centre(&self, state: &PersonState) -> DVec3 {
        self.arm(state).centre(&state.hand)
    }

    /// Whether the tracker has lost the hand at `tick`, for longer than a frame.
    pub fn is_lost(&self, state: &PersonState, tick: u64) -> bool {
        if self.is_unknown(state, tick) {
            return true;
        }
        let rng_of = |interval| self.random.at(Stream::Dropout, interval);
        self.policy.behaviour().is_some_and(|behaviour| random_policy::is_lost(behaviour, tick, rng_of))
    }

    /// Gives the present activity up: the gesture ends, the fingers let go of a part that the robot gives, or the part goes
    /// back to where it lay, unless the robot has a hand on it.
    fn give_up(&self, state: &mut PersonState, around: &Surroundings, done: &mut Manipulation) {
        match state.phase() {
            ActivityPhase::Show => self.withdraw(state, around),
            ActivityPhase::AwaitRelease => self.put_down(state, around, done),
            ActivityPhase::Dwell
            | ActivityPhase::Carry
            | ActivityPhase::AwaitTurn
            | ActivityPhase::AwaitSteadying
            | ActivityPhase::Mount
            | ActivityPhase::Give
                if around.robot.held != state.held.get() =>
            {
                self.take_back(state, around);
            }
            _ => return,
        }
        state.gives_up = 0;
    }

    /// Carries the held part back to where it lay, or what was mounted to a free place.
    pub(crate) fn take_back(&self, state: &mut PersonState, around: &Surroundings) {
        self.carry_to(state, around, (state.home.into(), DVec3::Z), WayKind::Carry);
        state.enter(ActivityPhase::Return, state.movement.end);
    }

    /// The fingers open.
    pub(crate) fn put_down(&self, state: &mut PersonState, around: &Surroundings, done: &mut Manipulation) {
        done.released = state.held.get();
        state.held = Slot::EMPTY;
        self.withdraw(state, around);
    }

    fn withdrawing(&self, state: &mut PersonState, around: &Surroundings) {
        (state.hand, _) = self.moving_pose(state, around.tick);
        if state.movement.is_over(around.tick) {
            state.ended = around.tick;
            state.set_occluder(None);
            let pause = self.policy.pause(&self.random, around.tick);
            state.enter(ActivityPhase::Rest, around.tick + pause);
        }
    }
}

/// What is wrong with the present activity as things are now.
pub(crate) fn error(state: &PersonState, around: &Surroundings) -> PartnerError {
    state.intention().map_or(PartnerError::None, |own| around.error_of(&own))
}
