use crate::body::{Body, FingerStop, Influence, Joints, Kinematic, Physics};
use crate::memory::Memory;
use crate::noise::Noise;
use crate::parts::{Holder, Parts};
use crate::person::{HandModel, Person, Plan, Surroundings};
use crate::robot_hand::{Palm, RobotHand};
use crate::sensors::{Capture, read_joints, recognise, track};
use crate::slot::Slot;
use crate::staging::{Sense, Staging};
use crate::{BodyKind, Partner, Settings, WorldError};
use bytemuck::Zeroable;
use coact_joint_task::{Fit, Task};
use coact_messages::{
    ARM_JOINTS, Command, JOINTS, NONE, PartnerPhase, SensorSample, Truth, WorldState, is_blocked,
};
use coact_robot::Robot;
use glam::DVec3;

/// Sockets of the world without dynamics: a part snaps into the one that it is let go near.
const SNAP: Fit = Fit { position: 0.03, angle: std::f64::consts::PI };
/// How long a finished assembly stands before the scene is laid out again, ticks.
const ADMIRED: u64 = 3000;
/// How long a part lies out of reach before it is put back, ticks.
const STRAY: u64 = 3000;
/// How far the robot's hand must be from where a part will lie, m.
const CLEARANCE: f64 = 0.15;

/// The stage that stands in for the hardware: advances table, parts, robot, person and sensors by one tick.
pub struct World {
    task: Task,
    noise: Noise,
    hand: RobotHand,
    person: Person,
    body: Body,
    joints: Joints,
    parts: Parts,
    memory: Memory,
    staging: Staging,
}

impl World {
    /// A world at its start: parts laid out as the task says, robot at its park posture with the hand open, the
    /// person's hand at rest.
    ///
    /// # Errors
    /// [`WorldError::Scene`] when the scene cannot be simulated as it is laid out.
    pub fn new(task: &Task, robot: &Robot, settings: Settings) -> Result<Self, WorldError> {
        let noise = Noise::new(settings.seed);
        let (plan, recorded, staging) = match settings.partner {
            Partner::Synthetic => (Plan::Synthetic, None, Staging::default()),
            Partner::Random(rates) => (Plan::Erring(rates), None, Staging::default()),
            Partner::Script(mut script) => {
                let staging = std::mem::take(&mut script.staging);
                (Plan::Script(script), None, staging)
            }
            Partner::Recorded(recorded) => (Plan::Synthetic, Some(recorded), Staging::default()),
        };
        let mut task = task.clone();
        staging.lay(&mut task);
        let fit = match settings.body {
            BodyKind::Kinematic => SNAP,
            BodyKind::Physics => task.scene.fit,
        };
        let parts = Parts::new(&task, staging.mounted(&task), fit);
        let joints = parked(robot);
        let body = match settings.body {
            BodyKind::Kinematic => Body::Kinematic(Kinematic::new()),
            BodyKind::Physics => Body::Physics(Box::new(Physics::new(&task, robot, &joints, &parts)?)),
        };
        Ok(Self {
            noise,
            hand: RobotHand::new(robot, &task),
            person: Person { model: HandModel::new(&task.scene), plan, noise, recorded },
            body,
            joints,
            parts,
            memory: Memory::zeroed(),
            staging,
            task,
        })
    }

    /// Advances the world to `tick`. Without a command the joints stay where they are.
    pub fn step(
        &mut self,
        tick: u64,
        command: Option<&Command>,
        out: &mut SensorSample,
        truth: &mut Truth,
        state: &mut WorldState,
    ) {
        if let Some(command) = command {
            self.memory.robot.wanted = coact_messages::finger_closure(&command.position);
        }
        let influence = Influence {
            elapsed: self.last_tick().map_or(1, |last| tick.saturating_sub(last).clamp(1, 1000)),
            command,
            task: &self.task,
            stop: FingerStop { hand: self.hand.stop(&self.memory.robot, &self.parts) },
            person: self.memory.person.hand.wrist(),
            held: self.memory.robot.held.get(),
            slipped: self.memory.robot.slipped.get(),
            pull: self.memory.person.force.into(),
        };
        self.body.advance(&influence, &mut self.joints, &mut self.parts);
        let palm = self.hand.palm(&self.joints.position);
        self.live(tick, &palm);
        self.sense(tick, out);
        self.memory.tick = tick;
        self.memory.started = 1;
        self.tell(truth);
        self.remember(state);
    }

    /// The person has said something: the next sample tells it.
    pub fn hear(&mut self, sentence: &str) {
        let next = self.last_tick().map_or(0, |last| last + 1);
        self.memory.heard.0.hear(next, sentence);
    }

    /// Actions of the script that were given up because there was no part to carry them out with.
    pub fn skipped(&self) -> u64 {
        self.memory.person.skipped
    }

    fn last_tick(&self) -> Option<u64> {
        (self.memory.started == 1).then_some(self.memory.tick)
    }

    /// Goes on from the newest message of a world that was killed: parts stay where they are, held ones stay held,
    /// and the person carries on. A state of another task is not resumed from.
    pub fn resume(&mut self, last: &WorldState) {
        if last.task != self.task.fingerprint || last.parts != self.task.parts.len() as u64 {
            return;
        }
        self.joints = Joints { position: last.position, velocity: last.velocity };
        self.parts.restore(&last.part);
        self.memory = Memory::load(last);
        self.body.resume(&self.joints, &self.parts);
    }

    /// Hands and parts: who grasps, carries and lets go of what.
    fn live(&mut self, tick: u64, palm: &Palm) {
        let Self { task, hand, person, body, parts, memory, staging, .. } = self;
        if memory.started == 0 {
            person.start(tick, &mut memory.person);
        }
        hand.advance(palm, body.grip(), &mut memory.robot, memory.person.grip, parts, task);
        let held = memory.robot.held.get().map(|part| parts.kind(part));
        let slip = held.and_then(|kind| staging.slip(kind, memory.robot.carried, memory.slipped));
        if let Some((index, slip)) = slip {
            memory.slipped |= 1 << index;
            hand.lose(&mut memory.robot, parts, slip.to, task);
        }
        hand.notice(tick, palm, &mut memory.robot, parts, task);
        let mut around = Surroundings { tick, task, parts, robot: &memory.robot };
        person.advance(&mut memory.person, &mut around);
        if let Some(sentence) = person.speak(&mut memory.person, task) {
            memory.heard.0.hear(tick, sentence);
        }
        self.tidy();
        self.begin_again(tick, palm);
    }

    /// Somebody puts back what fell off the table, or lies where neither of the two can take it from.
    fn tidy(&mut self) {
        let Self { task, parts, memory, .. } = self;
        for part in 0..parts.all().len() {
            memory.stray[part] = if parts.is_stray(part, task) { memory.stray[part] + 1 } else { 0 };
            if memory.stray[part] > STRAY {
                parts.put_back(part, task);
            }
        }
    }

    /// Lays the scene out again some time after the assembly was completed, once the robot's hand is out of the way.
    fn begin_again(&mut self, tick: u64, palm: &Palm) {
        let Self { task, parts, memory, .. } = self;
        if parts.achieved().count_ones() as usize != task.subgoals.len() || task.subgoals.is_empty() {
            memory.complete_since = 0;
            return;
        }
        if memory.complete_since == 0 {
            memory.complete_since = tick.max(1);
        }
        let clear = |at: &[f64; 2]| {
            DVec3::new(at[0], at[1], task.scene.table_height).distance(palm.grasp_point) > CLEARANCE
        };
        let empty = memory.robot.held.get().is_none() && memory.person.grip.get().is_none();
        let admired = tick >= memory.complete_since + ADMIRED;
        if admired && empty && task.parts.iter().all(|part| clear(&part.at)) {
            parts.lay_out(task);
            memory.assemblies += 1;
            memory.complete_since = 0;
        }
    }

    fn sense(&mut self, tick: u64, out: &mut SensorSample) {
        let last = self.last_tick();
        let Self { task, noise, hand, person, body, joints, parts, memory, staging, .. } = self;
        let ruled = || hand.touch(&memory.robot, parts);
        let touch = body.grip().map_or_else(ruled, |grip| grip.force);
        let of_person = DVec3::from(memory.person.force);
        let outside = match (body.outside(), memory.person.grip.get()) {
            // A pull goes through the body that measures it; what the person alone has is held by rules.
            (Some(outside), Some(part)) if parts.is(part, Holder::Person) => outside + of_person,
            (Some(outside), _) => outside,
            (None, _) => of_person,
        };
        read_joints(tick, noise, joints, (touch, outside), &mut out.joints);
        let (eye, (blocks, count)) = (task.scene.eye(), staging.occluders(tick, memory.person.screen()));
        let occluders = &blocks[..count];
        let Memory { person: moved, tracker, .. } = memory;
        let capture = || match person.recorded_keypoints(moved, tick) {
            _ if staging.is_blind(Sense::Hand, tick) => Capture::Nothing,
            Some(keypoints) => Capture::Recorded(keypoints),
            None if person.is_lost(tick) => Capture::Nothing,
            None => Capture::Simulated(person.model.keypoints(&moved.hand)),
        };
        track(tick, last, noise, tracker, capture, |place| is_blocked(occluders, eye, place, 0.0));
        out.hand = memory.tracker.delivered;
        if !staging.is_blind(Sense::Objects, tick) {
            recognise(tick, last, noise, parts, (eye, occluders), &mut memory.scene.0);
        }
        out.scene = memory.scene.0;
        out.heard = memory.heard.0;
    }

    fn tell(&self, truth: &mut Truth) {
        let person = &self.memory.person;
        truth.actions = person.actions as u32;
        let phase = person.phase();
        let of_action = |index: Slot| if phase == PartnerPhase::Idle { NONE } else { index.message() };
        truth.phase = phase as u32;
        truth.chain = of_action(person.chain);
        truth.subgoal = of_action(person.subgoal);
        truth.onset_cycle = person.onset;
        truth.grasp_cycle = person.grasped;
        truth.achieved = self.parts.achieved();
        truth.held = [Holder::Robot, Holder::Person].map(|holder| self.parts.held_by(holder));
        truth.assemblies = self.memory.assemblies;
        truth.error = if phase == PartnerPhase::Idle { 0 } else { person.error as u32 };
        truth.waiting = u32::from(person.waits());
        truth.hidden = u32::from(phase != PartnerPhase::Idle && person.screen().is_some());
    }

    fn remember(&self, state: &mut WorldState) {
        state.task = self.task.fingerprint;
        state.position = self.joints.position;
        state.velocity = self.joints.velocity;
        state.parts = self.parts.all().len() as u64;
        state.part = *self.parts.row();
        self.memory.save(state);
    }
}

/// Joints at the park posture, hand open.
pub(crate) fn parked(robot: &Robot) -> Joints {
    let mut position = [0.0; JOINTS];
    position[..ARM_JOINTS].copy_from_slice(&robot.park);
    Joints { position, velocity: [0.0; JOINTS] }
}

#[cfg(test)]
mod tests;
