use super::{Choice, Errand, HandModel, Intention, PersonMemory, Plan, Recorded, Stage, View, erring};
use crate::noise::{Noise, Stream};
use crate::parts::{Holder, Parts};
use crate::robot_hand::RobotHandMemory;
use crate::slot::Slot;
use coact_joint_task::Task;
use coact_messages::PartnerError;
use rand::RngExt;

/// How long the person waits for the robot's hand at the base, ms.
const HOLD_MS: u64 = 3000;
/// How long a part is held out to the robot, ms.
const OFFER_MS: u64 = 15_000;
/// How long a gesture is shown, ms.
const SHOW_MS: u64 = 12_000;
/// How long the person waits for the robot to let go, ms.
const RELEASE_MS: u64 = 10_000;

/// The human partner: carries out one intention after the other, stage by stage.
#[derive(Debug, Clone)]
pub(crate) struct Person {
    pub model: HandModel,
    pub plan: Plan,
    pub noise: Noise,
    /// Recorded reaches that drive the hand in place of the model's profiles.
    pub recorded: Option<Recorded>,
}

/// What the person acts upon in one tick.
pub(crate) struct Surroundings<'a> {
    pub tick: u64,
    pub task: &'a Task,
    pub parts: &'a mut Parts,
    pub robot: &'a RobotHandMemory,
}

impl Surroundings<'_> {
    pub fn view(&self) -> View<'_> {
        View { tick: self.tick, task: self.task, parts: self.parts, robot: self.robot }
    }
}

impl Person {
    /// The person at the start of a run: hand at rest.
    pub fn start(&self, tick: u64, memory: &mut PersonMemory) {
        memory.hand = self.model.rest();
        memory.enter(Stage::Rest, tick + self.plan.pause_ms(&self.noise, tick));
        memory.ended = tick;
    }

    /// One tick: moves the hand, and what it holds, and goes on to the next stage when the present one is over.
    pub fn advance(&self, memory: &mut PersonMemory, around: &mut Surroundings) {
        if memory.gives_up > 0 && around.tick >= memory.gives_up {
            self.give_up(memory, around);
        }
        let over = around.tick >= memory.until;
        match memory.stage() {
            Stage::Rest if over => self.decide(memory, around),
            Stage::Rest => {}
            Stage::Prepare if over => self.set_out(memory, around),
            Stage::Prepare => self.move_towards(memory, around),
            Stage::Reach => self.reach(memory, around),
            Stage::Dwell if over => self.lift(memory, around),
            Stage::Dwell => {}
            Stage::Carry | Stage::Return => self.carry_on(memory, around),
            Stage::AwaitHold if over || around.robot.holding_since > 0 => {
                self.begin_mounting(memory, around.tick)
            }
            Stage::AwaitHold => {}
            // What is to be given up is not mounted.
            Stage::Mount if over && memory.gives_up == 0 => self.put_down(memory, around),
            Stage::Mount => {}
            Stage::Offer => self.offer(memory, around),
            Stage::Show => self.show(memory, around),
            Stage::AwaitRelease => self.await_release(memory, around),
            Stage::Withdraw => self.withdrawing(memory, around),
        }
        self.exert(memory, around);
    }

    /// The sentence that the person says now: the script's, or the phrase that goes with the present action.
    pub fn speak<'a>(&'a self, memory: &mut PersonMemory, task: &'a Task) -> Option<&'a str> {
        let index = std::mem::take(&mut memory.says).get()?;
        match &self.plan {
            Plan::Script(script) => script.sentence(index),
            Plan::Erring(_) => task.chains.get(memory.chain.get()?)?.says.get(index).map(String::as_str),
            Plan::Synthetic => None,
        }
    }

    /// Gives the present action up: the gesture ends, the fingers let go of a part that the robot offers, or the part goes
    /// back to where it lay, unless the robot has a hand on it.
    fn give_up(&self, memory: &mut PersonMemory, around: &mut Surroundings) {
        match memory.stage() {
            Stage::Show => self.withdraw(memory, around),
            Stage::AwaitRelease => self.put_down(memory, around),
            Stage::Dwell | Stage::Carry | Stage::AwaitHold | Stage::Mount | Stage::Offer
                if around.robot.held != memory.grip =>
            {
                self.take_back(memory, around);
            }
            _ => return,
        }
        memory.gives_up = 0;
    }

    /// Carries the held part back to where it lay.
    pub(super) fn take_back(&self, memory: &mut PersonMemory, around: &Surroundings) {
        self.carry_to(memory, around, memory.home.into(), glam::DVec3::Z);
        memory.enter(Stage::Return, memory.movement.end);
    }

    fn decide(&self, memory: &mut PersonMemory, around: &Surroundings) {
        let mut rng = self.noise.at(Stream::Choice, around.tick);
        let now = *memory;
        let can_hide = |intention: &Intention| {
            let mut imagined = now;
            self.intend(*intention, &mut imagined, around);
            imagined.screen().is_some()
        };
        if self.comes_late(around) {
            memory.until = around.tick + 1;
            return;
        }
        match self.plan.next(&around.view(), memory, &can_hide, &mut rng) {
            Choice::Rest(pause) => memory.until = around.tick + pause.max(1),
            Choice::Begin(intention) => self.take_up(intention, memory, around),
        }
    }

    /// Makes an intention the present action.
    pub(super) fn take_up(&self, intention: Intention, memory: &mut PersonMemory, around: &Surroundings) {
        self.intend(intention, memory, around);
        memory.enter(Stage::Prepare, memory.movement.onset);
    }

    /// What the action will be like: how the hand will reach, and what stands in the way of the robot's sight.
    fn intend(&self, intention: Intention, memory: &mut PersonMemory, around: &Surroundings) {
        memory.chain = Slot::of(intention.chain);
        memory.subgoal = intention.subgoal.map_or(Slot::EMPTY, Slot::of);
        memory.part = intention.part.map_or(Slot::EMPTY, Slot::of);
        memory.set_errand(intention.errand);
        memory.manner = intention.manner;
        memory.recording = self.choose_recording(intention, around);
        memory.movement = self.reach_movement(memory, around);
        memory.set_screen(self.screen(memory, around));
    }

    /// One of the recorded reaches for a part of this width.
    fn choose_recording(&self, intention: Intention, around: &Surroundings) -> Slot {
        let (Some(recorded), Some(part)) = (&self.recorded, intention.part) else { return Slot::EMPTY };
        let width = around.task.kinds[around.parts.kind(part)].width;
        let turn =
            self.noise.at(Stream::Choice, around.tick).random_range(0..recorded.count_for(width).max(1));
        recorded.nth_for(width, turn).map_or(Slot::EMPTY, Slot::of)
    }

    /// Reach onset: an action begins.
    fn set_out(&self, memory: &mut PersonMemory, around: &Surroundings) {
        memory.actions += 1;
        memory.onset = around.tick;
        memory.grasped = 0;
        memory.gives_up = 0;
        memory.error = error(memory, around) as u64;
        if memory.manner.phrase != Slot::EMPTY {
            memory.says = memory.manner.phrase;
        }
        memory.enter(Stage::Reach, memory.movement.end);
        self.move_towards(memory, around);
    }

    fn reach(&self, memory: &mut PersonMemory, around: &mut Surroundings) {
        self.move_towards(memory, around);
        if memory.stage() == Stage::Reach && memory.movement.is_over(around.tick) {
            memory.hand = memory.movement.to;
            self.arrive(memory, around);
        }
    }

    /// Moves the empty hand towards its goal, wherever that is now; gives up when the part cannot be had any more.
    fn move_towards(&self, memory: &mut PersonMemory, around: &Surroundings) {
        if let Some(part) = memory.part.get() {
            if !can_grasp(memory.errand(), part, around) {
                return self.withdraw(memory, around);
            }
            self.aim(memory, around.parts.centre(part, around.task));
        }
        memory.hand = match memory.recording.get() {
            None => memory.movement.pose(around.tick),
            Some(_) => self.recorded_pose(memory, around.tick).unwrap_or(memory.hand),
        };
    }

    /// The fingers close on the part, or the gesture is fully shown.
    fn arrive(&self, memory: &mut PersonMemory, around: &mut Surroundings) {
        let tick = around.tick;
        if error(memory, around) == PartnerError::None {
            memory.error = PartnerError::None as u64;
        }
        let mistaken = self.plan.rates().is_some() && memory.error != PartnerError::None as u64;
        memory.gives_up = match memory.manner.gives_up {
            0 if mistaken => tick + erring::notices(&mut self.noise.at(Stream::Mistake, tick)),
            0 => 0,
            after => tick + after,
        };
        let Some(part) = memory.part.get() else {
            memory.grasped = tick;
            return memory.enter(Stage::Show, tick + SHOW_MS);
        };
        memory.grasped = tick;
        memory.grip = Slot::of(part);
        if around.parts.is(part, Holder::Robot) {
            if memory.gives_up == 0 {
                memory.gives_up = self.withdraws(tick);
            }
            return memory.enter(Stage::AwaitRelease, tick + RELEASE_MS);
        }
        around.parts.give_to(part, Holder::Person);
        memory.home = around.parts.position(part).into();
        let pause = self.noise.at(Stream::Movement, tick).random_range(80..140);
        memory.enter(Stage::Dwell, tick + pause);
    }

    /// Whether the tracker has lost the hand at `tick`, for longer than a frame.
    pub fn is_lost(&self, tick: u64) -> bool {
        let slot = |slot| self.noise.at(Stream::Dropout, slot);
        self.plan.rates().is_some_and(|rates| erring::is_lost(rates, tick, slot))
    }

    /// Sets off with the grasped part to where it is wanted.
    pub(super) fn lift(&self, memory: &mut PersonMemory, around: &mut Surroundings) {
        let scene = &around.task.scene;
        match (memory.errand(), memory.subgoal.get()) {
            (Errand::Mount | Errand::Take, Some(subgoal)) => {
                let goal = &around.task.subgoals[subgoal];
                self.carry_to(memory, around, goal.socket.into(), goal.axis.into());
            }
            _ => self.carry_to(memory, around, scene.handover.into(), glam::DVec3::Z),
        }
        memory.enter(Stage::Carry, memory.movement.end);
    }

    fn carry_on(&self, memory: &mut PersonMemory, around: &mut Surroundings) {
        self.carry(memory, around);
        if !memory.movement.is_over(around.tick) {
            return;
        }
        let waits = memory.subgoal.get().is_some_and(|subgoal| around.task.subgoals[subgoal].steadied);
        match (memory.stage(), memory.errand()) {
            (Stage::Return, _) => self.put_down(memory, around),
            (_, Errand::HandOver | Errand::Request) => {
                if memory.gives_up == 0 {
                    memory.gives_up = self.withdraws(around.tick);
                }
                memory.enter(Stage::Offer, around.tick + OFFER_MS);
            }
            _ if waits => memory.enter(Stage::AwaitHold, around.tick + HOLD_MS),
            _ => self.begin_mounting(memory, around.tick),
        }
    }

    fn begin_mounting(&self, memory: &mut PersonMemory, tick: u64) {
        let time = self.noise.at(Stream::Movement, tick).random_range(400..700);
        memory.enter(Stage::Mount, tick + time);
    }

    /// The fingers open: the part snaps into its socket, or stays where it was put.
    pub(super) fn put_down(&self, memory: &mut PersonMemory, around: &mut Surroundings) {
        if let Some(part) = memory.grip.get() {
            memory.grip = Slot::EMPTY;
            match around.robot.held.get() {
                Some(held) if held == part => around.parts.give_to(part, Holder::Robot),
                _ => around.parts.let_go(part, around.task),
            }
        }
        self.withdraw(memory, around);
    }

    fn withdrawing(&self, memory: &mut PersonMemory, around: &mut Surroundings) {
        memory.hand = memory.movement.pose(around.tick);
        if memory.movement.is_over(around.tick) {
            memory.ended = around.tick;
            memory.set_screen(None);
            let pause = self.plan.pause_ms(&self.noise, around.tick);
            memory.enter(Stage::Rest, around.tick + pause);
        }
    }
}

/// What is wrong with the present action as things are now.
fn error(memory: &PersonMemory, around: &Surroundings) -> PartnerError {
    memory.intention().map_or(PartnerError::None, |own| around.view().error_of(&own))
}

/// Whether the part is still where the action needs it: free to be taken, or in the robot's hand to be handed over.
fn can_grasp(errand: Errand, part: usize, around: &Surroundings) -> bool {
    match errand {
        Errand::Take => around.robot.held.get() == Some(part),
        _ => around.parts.is(part, Holder::Nobody),
    }
}
