//! A world without forces: joints follow their setpoints exactly, a part is held while the fingers are closed on it.
#![allow(clippy::unwrap_used, dead_code)]

use coact_control::Control;
use coact_joint_task::{ActionType, Task};
use coact_messages::{
    ArmSide, Command, FieldFrame, JOINTS, MotionPhase, NONE, PERSON, Percept, ROBOT, SensorSample,
    TrackedPoint,
};
use coact_motion::Capsule;
use coact_period::{CYCLES_PER_SECOND, PERIOD_S, seconds};
use coact_robot::{JointLimits, Robot};
use coact_safety::SafetyLimits;
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use std::path::{Path, PathBuf};

/// How near the palm's axis must be to a part's, and a part to its socket, m.
const NEAR: f64 = 0.03;

/// From the person's wrist to the fingertips that hold something, m.
const HAND: f64 = 0.12;

pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

pub fn robot() -> Robot {
    Robot::load(&root().join("rt-config/robots/aros.toml")).unwrap()
}

pub fn task() -> Task {
    Task::load(&root().join("rt-config/tasks/toy-vehicle.toml")).unwrap()
}

pub fn limits() -> SafetyLimits {
    SafetyLimits::load(&root().join("rt-config/safety.toml")).unwrap()
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Holder {
    Nobody,
    Robot,
    Person,
    Socket(usize),
}

#[derive(Debug, Clone)]
pub struct Part {
    pub kind: usize,
    pub workspace: usize,
    pub frame: Isometry3<f64>,
    pub holder: Holder,
}

pub struct KinematicWorld {
    pub task: Task,
    pub robot: Robot,
    pub control: Control,
    pub parts: Vec<Part>,
    pub tick: u64,
    pub sample: Box<SensorSample>,
    pub percept: Box<Percept>,
    pub frame: Box<FieldFrame>,
    pub command: Box<Command>,
    /// Phases as they came, each with the tick at which it began.
    pub phases: Vec<(MotionPhase, u64)>,
    /// Largest fraction of any velocity, acceleration and jerk limit that the setpoints used.
    pub used: [f64; 3],
    /// How much less the fingers' bases have closed than they are told, rad: something is between them.
    pub held_open: f64,
    history: [[f64; JOINTS]; 3],
    in_hand: Isometry3<f64>,
}

impl KinematicWorld {
    pub fn new() -> Self {
        let (task, robot) = (task(), robot());
        let control = Control::new(robot.clone(), &task, &limits()).unwrap();
        let height = task.scene.table_height;
        let parts = task.parts.iter().map(|part| Part {
            kind: part.kind,
            workspace: part.workspace.index(),
            frame: Isometry3::translation(part.at[0], part.at[1], height),
            holder: Holder::Nobody,
        });
        let mut world = Self {
            parts: parts.collect(),
            tick: 1000,
            sample: bytemuck::zeroed_box(),
            percept: bytemuck::zeroed_box(),
            frame: bytemuck::zeroed_box(),
            command: bytemuck::zeroed_box(),
            phases: Vec::new(),
            used: [0.0; 3],
            held_open: 0.0,
            history: [[0.0; JOINTS]; 3],
            in_hand: Isometry3::identity(),
            task,
            robot,
            control,
        };
        world.decide(None);
        for side in ArmSide::BOTH {
            world.arm_at(side, world.task.scene.rest(side), [0.0; 3]);
            world.percept.arms[side as usize].tracked = 1;
        }
        let park = world.robot.hand.posture(world.robot.hand.base_for_width(0.10));
        world.command.position[..7].copy_from_slice(&world.robot.park);
        world.command.position[7..14].copy_from_slice(&park);
        world.history = [world.command.position; 3];
        world
    }

    /// Index of the action with this skill for a subgoal of this name.
    pub fn action(&self, motion: ActionType, subgoal: &str) -> u32 {
        let named = |index: &usize| {
            let action = &self.task.actions[*index];
            let goal = action.subgoal.map(|goal| self.task.subgoals[goal].name.as_str());
            action.action_type == motion && goal == Some(subgoal)
        };
        (0..self.task.actions.len()).find(named).unwrap_or_else(|| panic!("no {motion:?} for {subgoal}"))
            as u32
    }

    pub fn decide(&mut self, action: Option<u32>) {
        self.frame.decision.action = action.unwrap_or(NONE);
        self.frame.decision.since = self.tick;
    }

    /// Puts the person's hand somewhere, still.
    pub fn hand_at(&mut self, place: [f64; 3]) {
        self.hand_moves(place, [0.0; 3]);
    }

    /// The person's right wrist is there, and moves so fast, m/s.
    pub fn hand_moves(&mut self, place: [f64; 3], velocity: [f64; 3]) {
        self.arm_at(ArmSide::Right, place, velocity);
    }

    /// One of the person's wrists is there, and moves so fast, m/s; the arm is stretched out to it, and the hand beyond.
    pub fn arm_at(&mut self, side: ArmSide, place: [f64; 3], velocity: [f64; 3]) {
        let shoulder = Vector3::from(self.task.scene.shoulder(side));
        let arm = Vector3::from(place) - shoulder;
        let hand = 1.0 + HAND / arm.norm().max(HAND);
        let point = |follows: f64| TrackedPoint {
            position: (shoulder + follows * arm).into(),
            velocity: velocity.map(|speed| follows.min(1.0) * speed),
            deviation: 0.0,
            age: 0,
            still: if velocity == [0.0; 3] { 1000 } else { 0 },
        };
        let person = &mut self.percept.arms[side as usize];
        (person.shoulder, person.elbow) = (point(0.0), point(0.5));
        (person.wrist, person.fingertip) = (point(1.0), point(hand));
    }

    /// Puts the person's finger tips somewhere, still.
    pub fn fingers_at(&mut self, place: [f64; 3]) {
        self.fingers_move(place, [0.0; 3]);
    }

    /// Puts the finger tips of the person's left hand somewhere, still.
    pub fn left_fingers_at(&mut self, place: [f64; 3]) {
        let arm = Vector3::from(place) - Vector3::from(self.task.scene.shoulder(ArmSide::Left));
        let wrist = Vector3::from(place) - HAND * arm.normalize();
        self.arm_at(ArmSide::Left, wrist.into(), [0.0; 3]);
    }

    /// The person's finger tips are there, and the hand moves so fast, m/s.
    pub fn fingers_move(&mut self, place: [f64; 3], velocity: [f64; 3]) {
        let arm = Vector3::from(place) - Vector3::from(self.task.scene.person_shoulder);
        let wrist = Vector3::from(place) - HAND * arm.normalize();
        self.hand_moves(wrist.into(), velocity);
    }

    /// Somebody pulls at the hand and what it holds, N.
    pub fn pull(&mut self, force: [f64; 3]) {
        self.sample.joints.wrist_force = force;
    }

    pub fn palm(&self) -> Isometry3<f64> {
        self.robot.palm(&self.command.position)
    }

    pub fn grasp_point(&self) -> Point3<f64> {
        self.robot.grasp_point(&self.command.position)
    }

    /// How far the hand is from the nearest place where the base is steadied, m.
    pub fn away_from_base(&self) -> f64 {
        let away = |place: &[f64; 3]| (self.grasp_point() - Point3::from(*place)).norm();
        self.task.scene.steady.iter().map(away).fold(f64::INFINITY, f64::min)
    }

    /// Puts a part into the robot's hand, however it lies in there.
    pub fn give(&mut self, part: usize, in_palm: Isometry3<f64>) {
        self.parts[part].holder = Holder::Robot;
        self.in_hand = in_palm;
    }

    pub fn held(&self) -> Option<&Part> {
        self.parts.iter().find(|part| part.holder == Holder::Robot)
    }

    pub fn phase(&self) -> MotionPhase {
        self.phases.last().map_or(MotionPhase::Rest, |last| last.0)
    }

    /// Runs until `done`, for at most `most` s; the seconds it took.
    pub fn until(&mut self, most: f64, what: &str, mut done: impl FnMut(&Self) -> bool) -> f64 {
        let start = self.tick;
        while !done(self) {
            let passed = seconds(self.tick - start);
            assert!(passed < most, "not within {most} s: {what}; phases {:?}", self.phases);
            self.step();
        }
        seconds(self.tick - start)
    }

    pub fn run(&mut self, seconds: f64) {
        for _ in 0..(seconds * CYCLES_PER_SECOND as f64) as u64 {
            self.step();
        }
    }

    /// One cycle with fresh messages.
    pub fn step(&mut self) {
        self.sense();
        let (sample, percept, frame) = (self.sample.clone(), self.percept.clone(), self.frame.clone());
        self.step_with(Some(&sample), Some(&percept), Some(&frame));
    }

    /// One cycle with whatever messages.
    pub fn step_with(
        &mut self,
        sample: Option<&SensorSample>,
        percept: Option<&Percept>,
        frame: Option<&FieldFrame>,
    ) {
        let previous = self.command.clone();
        let previous = (self.tick > 1000).then_some(&*previous);
        self.control.step(self.tick, sample, percept, frame, previous, &mut self.command);
        self.check_limits();
        self.grasp_and_release();
        let phase = phase(self.command.phase);
        if self.phases.last().map(|last| last.0) != Some(phase) {
            self.phases.push((phase, self.tick));
        }
        self.tick += 1;
    }

    pub fn sense(&mut self) {
        let tick = self.tick;
        for header in [&mut self.sample.header, &mut self.percept.header, &mut self.frame.header] {
            header.cycle = tick;
        }
        self.sample.joints.position = self.command.position;
        self.sample.joints.position[8..11]
            .iter_mut()
            .for_each(|base| *base = (*base - self.held_open).max(0.0));
        self.sample.joints.velocity = self.command.velocity;
        self.sample.joints.touch = if self.held().is_some() { 3.0 } else { 0.0 };
        let Self { percept, parts, task, sample, .. } = self;
        if tick.is_multiple_of(33) {
            sample.scene.captured_cycle = tick;
            sample.scene.sightings = parts.len() as u32;
            for (sighting, part) in sample.scene.sighting.iter_mut().zip(parts.iter()) {
                sighting.kind = part.kind as u32;
                sighting.confidence = 1.0;
                sighting.position = part.frame.translation.vector.into();
                sighting.orientation = part.frame.rotation.coords.into();
            }
        }
        for workspace in &mut percept.workspace {
            workspace.seen.fill(0.0);
        }
        percept.robot_holds.fill(0.0);
        percept.person_holds.fill(0.0);
        percept.open = std::array::from_fn(|goal| f64::from(u8::from(goal < task.subgoals.len())));
        percept.achieved.fill(0.0);
        for part in parts.iter() {
            match part.holder {
                Holder::Nobody => {
                    let seen = &mut percept.workspace[part.workspace];
                    seen.seen[part.kind] = 1.0;
                    seen.position[part.kind] = part.frame.translation.vector.into();
                    seen.orientation[part.kind] = [0.0, 0.0, 0.0, 1.0];
                }
                Holder::Robot => percept.robot_holds[part.kind] = 1.0,
                Holder::Person => percept.person_holds[part.kind] = 1.0,
                Holder::Socket(goal) => (percept.open[goal], percept.achieved[goal]) = (0.0, 1.0),
            }
        }
    }

    fn height(&self, kind: usize) -> f64 {
        self.task.kinds[kind].shape.height()
    }

    fn grasp_and_release(&mut self) {
        let palm = self.palm();
        let width = self.robot.hand.width(self.command.position[8]);
        if let Some(index) = self.parts.iter().position(|part| part.holder == Holder::Robot) {
            self.parts[index].frame = palm * self.in_hand;
            if width > self.task.kinds[self.parts[index].kind].width + 0.004 {
                self.release(index);
            }
            return;
        }
        let line = |frame: &Isometry3<f64>, from: f64, to: f64| {
            let [start, end] = [from, to].map(|z| frame * Point3::new(0.0, 0.0, z));
            Capsule { start, end, radius: 0.0 }
        };
        let hand = line(&palm, self.robot.hand.palm_face, self.robot.hand.grasp_distance);
        let between = |part: &Part| {
            let gap = hand.distance(&line(&part.frame, 0.0, self.height(part.kind)));
            let free = matches!(part.holder, Holder::Nobody | Holder::Person);
            free && gap < NEAR && width <= self.task.kinds[part.kind].width
        };
        if let Some(index) = self.parts.iter().position(between) {
            self.parts[index].holder = Holder::Robot;
            self.in_hand = palm.inverse() * self.parts[index].frame;
        }
    }

    fn release(&mut self, index: usize) {
        let Part { kind, frame, .. } = self.parts[index].clone();
        let place = frame.translation.vector;
        let matching = |goal: &usize| {
            let subgoal = &self.task.subgoals[*goal];
            let upright = (frame.rotation * Vector3::z()).dot(&Vector3::from(subgoal.axis));
            subgoal.kind == kind && (place - Vector3::from(subgoal.socket)).norm() < NEAR && upright > 0.99
        };
        let wrist = Point3::from(self.percept.arms[0].wrist.position);
        let part = &mut self.parts[index];
        if let Some(goal) = (0..self.task.subgoals.len()).find(matching) {
            let subgoal = &self.task.subgoals[goal];
            part.holder = Holder::Socket(goal);
            part.frame.translation = Translation3::from(subgoal.socket);
        } else if (wrist.coords - place).norm() < 0.25 {
            part.holder = Holder::Person;
        } else {
            part.holder = Holder::Nobody;
            part.workspace = if place.x > -0.75 { ROBOT } else { PERSON };
            part.frame = Isometry3::from_parts(
                Translation3::new(place.x, place.y, self.task.scene.table_height),
                UnitQuaternion::identity(),
            );
        }
    }

    /// Holds the finite differences of what was sent against the limits.
    fn check_limits(&mut self) {
        let limits = self.robot.limits();
        let [oldest, older, old] = self.history;
        for (joint, JointLimits { lower, upper, velocity, acceleration, jerk, .. }) in
            limits.iter().enumerate()
        {
            let now = self.command.position[joint];
            assert!(now >= *lower && now <= *upper, "joint {joint} at {now} rad");
            let v = |a: f64, b: f64| (a - b) / PERIOD_S;
            let (v2, v1, v0) =
                (v(now, old[joint]), v(old[joint], older[joint]), v(older[joint], oldest[joint]));
            let (a1, a0) = ((v2 - v1) / PERIOD_S, (v1 - v0) / PERIOD_S);
            let used = [v2 / velocity, a1 / acceleration, (a1 - a0) / PERIOD_S / jerk].map(f64::abs);
            for (order, used) in used.into_iter().enumerate() {
                // Third differences of numbers near 2 one period apart round to about 1e-6 rad/s³.
                assert!(used <= 1.0 + 1e-4, "joint {joint}, derivative {}: {used} of its limit", order + 1);
                self.used[order] = self.used[order].max(used);
            }
        }
        self.history = [older, old, self.command.position];
    }
}

fn phase(word: u32) -> MotionPhase {
    MotionPhase::ALL.into_iter().find(|phase| *phase as u32 == word).unwrap_or_else(|| panic!("phase {word}"))
}
