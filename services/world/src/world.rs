mod outputs;

use crate::dynamics::{FingerStop, Influence, Joints, SimulatedRobot};
use crate::hand_recording::HandRecording;
use crate::palm::Palm;
use crate::parts::Parts;
use crate::robot_hand::RobotHand;
use crate::robot_shape::RobotShape;
use crate::scenario::Staging;
use crate::simulation_state::SimulationState;
use crate::{Partner, ResumeError, Settings, WorldError};
use bytemuck::Zeroable;
use coact_drive::{Drive, joint_limits};
use coact_joint_task::{Fit, Task};
use coact_messages::{ARM_JOINTS, Command, HoldReason, JOINTS, SensorSample, Truth, WorldState};
use coact_period::{CYCLES_PER_SECOND, cycles};
use coact_person::{Holder, Manipulation, Person, Policy, Surroundings};
use coact_pipeline::WorldMode;
use coact_random::RandomStreams;
use coact_robot::Robot;
use coact_stage_state::{Flag, Slot, StageState, finite};
use glam::DVec3;
use std::time::Duration;

/// Sockets of the world without dynamics: a part snaps into the one that it is let go near. Any angle will do,
/// for without dynamics nothing turns a part. The distance, m, is chosen by hand: less than between two sockets.
const SNAP: Fit = Fit { position: 0.03, angle: std::f64::consts::PI };
/// How long a finished assembly stands before the scene is laid out again, cycles.
const FINISHED: u64 = cycles(Duration::from_secs(3));
/// How long a part lies out of reach before it is put back, cycles.
const STRAY: u64 = cycles(Duration::from_secs(3));
/// How far the robot's hand must be from where a part will lie, m: more than the half width of the open hand.
const HAND_CLEARANCE: f64 = 0.15;

/// The stage that stands in for the hardware: advances table, parts, robot, person and sensors by one tick.
pub struct World {
    task: Task,
    random: RandomStreams,
    hand: RobotHand,
    person: Person,
    /// Where the person's hand is, if it moves as in a recorded run.
    again: Option<HandRecording>,
    /// Between the commands and the joints.
    drive: Drive,
    /// Why the joints may not move now.
    hold: HoldReason,
    /// The cameras show nothing before this tick.
    blind_until: u64,
    robot: SimulatedRobot,
    /// Its links, as the cameras see them.
    shape: RobotShape,
    joints: Joints,
    parts: Parts,
    simulation: SimulationState,
    staging: Staging,
}

impl World {
    /// A world at its start: parts laid out as the task says, robot at its park posture with the hand open, the
    /// person's hand at rest.
    ///
    /// # Errors
    /// [`WorldError::Scene`] when the scene cannot be simulated as it is laid out.
    pub fn new(task: &Task, robot: &Robot, settings: Settings) -> Result<Self, WorldError> {
        let random = RandomStreams::new(settings.seed);
        let mut again = None;
        let (policy, recorded, staging) = match settings.partner {
            Partner::Synthetic => (Policy::Synthetic, None, Staging::default()),
            Partner::Active => (Policy::Active, None, Staging::default()),
            Partner::Random(behaviour) => (Policy::Random(behaviour), None, Staging::default()),
            Partner::Script(scenario) => (Policy::Script(scenario.script), None, scenario.staging),
            Partner::Arm(arm) => (Policy::Arm(arm), None, Staging::default()),
            Partner::Hand => (Policy::Live, None, Staging::default()),
            Partner::Again(recording) => {
                again = Some(recording);
                (Policy::Live, None, Staging::default())
            }
            Partner::Recorded(recorded) => (Policy::Synthetic, Some(recorded), Staging::default()),
        };
        let mut task = task.clone();
        staging.lay(&mut task);
        let fit = match settings.mode {
            WorldMode::Kinematic => SNAP,
            WorldMode::Physics => task.scene.fit,
        };
        let parts = Parts::new(&task, staging.mounted(&task), fit);
        let joints = parked(robot);
        Ok(Self {
            random,
            hand: RobotHand::new(robot, &task),
            person: Person::new(&task.scene, &settings.habits, policy, random, recorded.or(settings.reaches))
                .with_ways(settings.ways),
            again,
            drive: Drive::new(joint_limits(robot), settings.drive),
            hold: HoldReason::None,
            blind_until: 0,
            robot: SimulatedRobot::new(settings.mode, &task, robot, &joints, &parts)?,
            shape: RobotShape::new(robot)?,
            joints,
            parts,
            simulation: SimulationState::zeroed(),
            staging,
            task,
        })
    }

    /// Advances the world to `tick`. The joints follow the drive, which follows `command` if it is good. A body does not wait for
    /// a world that is late: drive, joints and loose parts take a step for each tick since the last one, at most for a second. With dynamics, where a step may
    /// take longer than a period, they take one: the world goes slower instead.
    pub fn step(
        &mut self,
        tick: u64,
        command: Option<&Command>,
        out: &mut SensorSample,
        truth: &mut Truth,
        checkpoint: &mut WorldState,
    ) {
        let passed = self.last_tick().map_or(1, |last| tick.saturating_sub(last).clamp(1, CYCLES_PER_SECOND));
        let steps = self.robot.steps(passed);
        let first = tick - (steps - 1).min(tick);
        // A command takes effect in the tick after the sample that it answers.
        let due = command.map_or(tick, |command| (command.header.cycle + 1).clamp(first, tick));
        for now in first..=tick {
            match now == due {
                true => self.drive.step(now, command, self.hold, &self.joints.position),
                false => self.drive.make_up(now, &self.joints.position),
            }
            self.move_robot();
        }
        let palm = self.hand.palm(&self.joints.position);
        self.live(tick, &palm);
        self.sense(tick, out);
        self.drive.start(tick, &out.joints.position);
        out.drive = self.drive.report();
        self.simulation.tick = tick;
        self.simulation.started = Flag::Set;
        self.tell(truth);
        self.write(checkpoint);
    }

    /// Joints and loose parts follow the drive for a tick.
    fn move_robot(&mut self) {
        if let Some(setpoints) = self.drive.setpoints() {
            let position = setpoints.map(|joint| joint.position);
            self.simulation.robot.commanded_closure = coact_messages::finger_closure(&position);
        }
        let influence = Influence {
            setpoints: self.drive.setpoints(),
            task: &self.task,
            stop: FingerStop { hand: self.hand.stop(&self.simulation.robot, &self.parts) },
            person: self.simulation.person.hand.wrist(),
            held: self.simulation.robot.held.get(),
            slipped: self.simulation.robot.slipped.get(),
            pull: self.simulation.person.force.into(),
        };
        self.robot.advance(&influence, &mut self.joints, &mut self.parts);
    }

    /// Says why the joints may not move from now on, if there is a reason: they brake and stand.
    pub fn hold(&mut self, reason: HoldReason) {
        self.hold = reason;
    }

    /// The cameras show nothing from now on, for so long: a drop-out. Encoders and force sensor go on.
    pub fn drop_out(&mut self, time: Duration) {
        self.blind_until = self.last_tick().map_or(0, |last| last + 1) + cycles(time);
    }

    /// Whether the joints' setpoints stand still.
    pub fn stands(&self) -> bool {
        self.drive.stands()
    }

    /// The person has said something: the next sample tells it.
    pub fn hear(&mut self, sentence: &str) {
        let next = self.last_tick().map_or(0, |last| last + 1);
        self.simulation.heard.hear(next, sentence);
    }

    /// A program outside has told where the person's hand is, in the order of [`KeypointName`](coact_messages::KeypointName), m: it is on
    /// its way there from the next step on. Of another partner than [`Partner::Hand`] nothing is told from outside.
    pub fn show_hand(&mut self, points: &[[f64; 3]; 9]) {
        let next = self.last_tick().map_or(0, |last| last + 1);
        self.person.show_hand(&mut self.simulation.person, next, points);
    }

    /// Actions of the script that were given up because there was no part to carry them out with.
    pub fn skipped(&self) -> u64 {
        self.simulation.person.skipped
    }

    fn last_tick(&self) -> Option<u64> {
        self.simulation.started.is_set().then_some(self.simulation.tick)
    }

    /// Goes on from the newest message of a world that was killed: parts stay where they are, held ones stay held,
    /// and the person carries on.
    ///
    /// # Errors
    /// [`ResumeError`] for the state of another task, and for a damaged one. The world then stays as it was.
    pub fn resume(&mut self, last: &WorldState) -> Result<(), ResumeError> {
        let (found, expected) = (last.task, self.task.fingerprint);
        if found != expected || last.parts != self.task.parts.len() as u64 {
            return Err(ResumeError::OtherTask { found, expected });
        }
        let simulation = SimulationState::load(&last.state)?;
        self.person.check(&simulation.person, &self.task, simulation.tick)?;
        simulation.robot.check(self.task.parts.len(), simulation.tick)?;
        finite("joints", &[last.position, last.velocity].concat())?;
        let mut drive = self.drive.clone();
        drive.resume(&simulation.drive)?;
        self.parts.restore(&last.part, &self.task)?;
        self.drive = drive;
        self.joints = Joints { position: last.position, velocity: last.velocity };
        self.simulation = simulation;
        self.robot.resume(&self.joints, &self.parts);
        Ok(())
    }

    /// Hands and parts: who grasps, carries and lets go of what.
    fn live(&mut self, tick: u64, palm: &Palm) {
        let Self { task, hand, person, again, robot, parts, simulation, staging, .. } = self;
        if !simulation.started.is_set() {
            person.start(tick, &mut simulation.person);
        }
        if let Some(points) = again.as_ref().and_then(|recording| recording.captured_in(tick)) {
            person.show_hand(&mut simulation.person, tick, points);
        }
        hand.advance(palm, robot.grip(), &mut simulation.robot, simulation.person.held, parts, task);
        let held = simulation.robot.held.get().map(|part| parts.kind(part));
        let slip = held.and_then(|kind| staging.slip(kind, simulation.robot.carried, simulation.slipped));
        if let Some((index, slip)) = slip {
            simulation.slipped |= 1 << index;
            hand.lose(&mut simulation.robot, parts, slip.to, task);
        }
        hand.notice(tick, palm, &mut simulation.robot, parts, task);
        let around = Surroundings { tick, task, parts: parts.view(), robot: simulation.robot.view() };
        let done = person.advance(&mut simulation.person, &around);
        handle(&done, simulation.robot.held, robot, parts, task);
        if let Some(sentence) = person.speak(&mut simulation.person, task) {
            simulation.heard.hear(tick, sentence);
        }
        self.tidy();
        self.begin_again(tick, palm);
    }

    /// Somebody puts back what fell off the table, or lies where neither of the two can take it from.
    fn tidy(&mut self) {
        let Self { task, parts, simulation, .. } = self;
        for part in 0..parts.all().len() {
            simulation.stray[part] = if parts.is_stray(part, task) { simulation.stray[part] + 1 } else { 0 };
            if simulation.stray[part] > STRAY {
                parts.put_back(part, task);
            }
        }
    }

    /// Lays the scene out again some time after the assembly was completed, once the robot's hand is out of the way.
    fn begin_again(&mut self, tick: u64, palm: &Palm) {
        let Self { task, parts, simulation, .. } = self;
        if !task.is_complete(parts.achieved()) {
            simulation.complete_since = 0;
            return;
        }
        if simulation.complete_since == 0 {
            simulation.complete_since = tick.max(1);
        }
        let clear = |at: &[f64; 2]| {
            DVec3::new(at[0], at[1], task.scene.table_height).distance(palm.grasp_point) > HAND_CLEARANCE
        };
        let empty = simulation.robot.held.get().is_none() && simulation.person.held.get().is_none();
        let has_stood = tick >= simulation.complete_since + FINISHED;
        if has_stood && empty && task.parts.iter().all(|part| clear(&part.at)) {
            parts.lay_out(task);
            simulation.assemblies += 1;
            simulation.complete_since = 0;
        }
    }

    fn write(&mut self, checkpoint: &mut WorldState) {
        checkpoint.task = self.task.fingerprint;
        checkpoint.position = self.joints.position;
        checkpoint.velocity = self.joints.velocity;
        checkpoint.parts = self.parts.all().len() as u64;
        checkpoint.part = *self.parts.row();
        self.simulation.drive = *self.drive.state();
        self.simulation.store(&mut checkpoint.state);
    }
}

/// Carries out what the person's hand did to the parts. A part that the robot has as well stays with the robot when the
/// person lets it go.
fn handle(
    done: &Manipulation,
    held_by_robot: Slot,
    robot: &mut SimulatedRobot,
    parts: &mut Parts,
    task: &Task,
) {
    if let Some(part) = done.grasped {
        parts.give_to(part, Holder::Person);
    }
    if let Some((part, position, orientation)) = done.moved {
        robot.carry(part, position, orientation, parts);
    }
    match done.released {
        Some(part) if held_by_robot.get() == Some(part) => parts.give_to(part, Holder::Robot),
        Some(part) => parts.let_go(part, task),
        None => {}
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
