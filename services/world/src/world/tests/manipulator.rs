use super::{Out, config};
use crate::dynamics::SimulatedRobot;
use crate::scenario::Staging;
use crate::{Partner, Scenario, Settings, World};
use bytemuck::zeroed_box;
use coact_joint_task::{Agent, Part, Subgoal, Task};
use coact_messages::{ARM_JOINTS, Command, DriveMode, Header, LAYOUT};
use coact_motion::{Goal, Mechanism, Problem, Scene};
use coact_period::{CYCLES_PER_SECOND, seconds};
use coact_pipeline::WorldMode;
use coact_robot::{
    Grip, GripKind, GripSide, Grips, HandGoal, JointLimits, MotionState, NextUse, PointToPoint, Posture,
    ROBOT_JOINTS, Robot,
};
use glam::{DQuat, DVec3};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// How far before it grips or places something the hand is, m.
const BACK: f64 = 0.15;
/// Where it passes on its way there, m: joints that move together make no straight line.
const NEARER: [f64; 5] = [0.12, 0.09, 0.06, 0.03, 0.012];

/// How parts are taken if nothing else is said.
const ABOVE: (GripKind, GripSide) = (GripKind::Precision, GripSide::Above);

/// A robot in the physics world with one part on the table, moved posture by posture.
pub(super) struct Manipulator {
    pub world: World,
    pub out: Out,
    scenario: Scenario,
    robot: Robot,
    limits: [JointLimits; ROBOT_JOINTS],
    at: [f64; ROBOT_JOINTS],
    tick: u64,
    /// How it takes the part.
    pub grip: (GripKind, GripSide),
    /// Largest deviation of an arm joint from its setpoint so far, rad.
    pub deviation: f64,
}

/// What the fingers do.
#[derive(Debug, Clone, Copy)]
pub(super) enum Fingers {
    Open,
    Closed,
}

/// Where a part is in the robot's palm.
#[derive(Debug, Clone, Copy)]
pub(super) struct InHand {
    pub place: DVec3,
    pub turn: DQuat,
}

impl InHand {
    /// How far it has moved since `before`: m and degrees.
    pub fn since(&self, before: &Self) -> (f64, f64) {
        (self.place.distance(before.place), self.turn.angle_between(before.turn).to_degrees())
    }
}

impl Manipulator {
    /// One part of `kind` at `at` on the table.
    pub fn new(kind: &str, at: [f64; 2]) -> Self {
        Self::with(super::robot(), kind, at)
    }

    /// The same with another robot.
    pub fn with(robot: Robot, kind: &str, at: [f64; 2]) -> Self {
        Self::among(robot, kind, at, |_| Vec::new())
    }

    /// The same with the parts in place on which that one is mounted on the robot's side.
    pub fn assembling(kind: &str, at: [f64; 2]) -> Self {
        Self::among(super::robot(), kind, at, |task| {
            let own = |goal: &Subgoal| goal.side == Agent::Robot && task.kinds[goal.kind].name == kind;
            let mut before = vec![task.subgoals.iter().position(own).unwrap()];
            for next in 0.. {
                let Some(&goal) = before.get(next) else { break };
                let new = task.subgoals[goal].after.iter().filter(|goal| !before.contains(goal));
                before.extend(new.copied().collect::<Vec<_>>());
            }
            before.split_off(1)
        })
    }

    /// A part of `kind`, and those of the subgoals that are achieved.
    fn among(robot: Robot, kind: &str, at: [f64; 2], achieved: impl Fn(&Task) -> Vec<usize>) -> Self {
        let mut task = Task::load(&config("tasks/toy-vehicle.toml")).unwrap();
        let staging = Staging { achieved: achieved(&task), ..Staging::default() };
        let index = task.kinds.iter().position(|known| known.name == kind).unwrap();
        let first = task.parts.iter().position(|part| part.kind == index).unwrap();
        let own = Part { at, workspace: Agent::Robot, ..task.parts[first] };
        let mounted = staging.mounted(&task).into_iter().map(|(_, part)| task.parts[part].clone());
        task.parts = std::iter::once(own).chain(mounted).collect();
        let scenario = Scenario { staging, ..Scenario::default() };
        let world = World::new(&task, &robot, settings(&scenario)).unwrap();
        let mut at = [0.0; ROBOT_JOINTS];
        at[..ARM_JOINTS].copy_from_slice(&robot.park);
        let limits = robot.planned_limits();
        let mut own = Self {
            world,
            out: Out::new(),
            scenario,
            robot,
            limits,
            at,
            tick: 0,
            grip: ABOVE,
            deviation: 0.0,
        };
        own.world.drive.start(0, &own.world.joints.position);
        own
    }

    /// One that has taken a part of `kind` and holds it above the table; it took the part for lying up to 3 mm beside.
    pub fn holding(kind: &str, seed: u64) -> Self {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut any = |low: f64, high: f64| random.random_range(low..high);
        let at = [any(-0.52, -0.32), any(0.50, 0.72)];
        let mut robot = Self::new(kind, at);
        robot.stay(50);
        let table = robot.world.task.scene.table_height;
        robot.pick(DVec3::new(at[0] + any(-0.003, 0.003), at[1] + any(-0.003, 0.003), table), DVec3::Z);
        robot
    }

    /// The grips for the part.
    fn grips(&self) -> Grips {
        let kind = &self.world.task.kinds[self.world.parts.kind(0)];
        Grips::of(&self.robot.hand, coact_workplace::graspable(kind), NextUse::Anything)
    }

    /// Whether this is the grip that it uses.
    fn uses(&self, grip: &Grip) -> bool {
        (grip.kind, grip.side) == self.grip
    }

    /// Postures for gripping the part when its frame is at `place` with its axis along `axis`.
    pub fn reach(&self, place: DVec3, axis: DVec3) -> (Posture, Posture) {
        self.bring(BACK, place, axis)
    }

    /// The same, and where the hand is `back` m before with the part in it, on the part's own axis.
    fn bring(&self, back: f64, place: DVec3, axis: DVec3) -> (Posture, Posture) {
        let along = -nalgebra::Vector3::from(axis.to_array());
        self.reach_from(back, place, axis, |goal| HandGoal { along, ..goal })
    }

    fn reach_from(
        &self,
        back: f64,
        place: DVec3,
        axis: DVec3,
        goal: impl Fn(HandGoal) -> HandGoal,
    ) -> (Posture, Posture) {
        let turn = DQuat::from_rotation_arc(DVec3::Z, axis);
        let turn = UnitQuaternion::from_quaternion(Quaternion::new(turn.w, turn.x, turn.y, turn.z));
        let frame = Isometry3::from_parts(Translation3::new(place.x, place.y, place.z), turn);
        let grips = self.grips();
        let goals = grips.goals(&frame, back, self.world.task.scene.table_height);
        let goals =
            goals.into_iter().filter(|(grip, _)| self.uses(&grips.all[*grip])).map(|(_, own)| goal(own));
        let from: Posture = self.at[..ARM_JOINTS].try_into().unwrap();
        let mechanism = Mechanism::of(&self.robot).unwrap();
        let open = mechanism.with_fingers(&self.robot.hand, &grips.open).unwrap();
        let (scene, start) = (Scene::default(), from.map(MotionState::at_rest));
        let problem = Problem::new(&mechanism, &open, &scene, start, Goal::Hand(goals.collect()));
        let target = problem.targets_from(&from)[0];
        (target.before, target.at)
    }

    /// Moves to an arm posture with the fingers open around the part, or closed on it.
    pub fn go(&mut self, arm: &Posture, fingers: Fingers) {
        self.watch(arm, fingers, |_| {});
    }

    /// The same; `look` sees every tick.
    pub fn watch(&mut self, arm: &Posture, fingers: Fingers, mut look: impl FnMut(&Self)) {
        let grips = self.grips();
        let grip = grips.all.iter().find(|grip| self.uses(grip)).unwrap();
        let angles = match fingers {
            Fingers::Open => grips.open,
            Fingers::Closed => grip.fingers(&self.robot.hand, &grips.object, -0.3 * grips.object.width),
        };
        let mut target = [0.0; ROBOT_JOINTS];
        target[..ARM_JOINTS].copy_from_slice(arm);
        target[ARM_JOINTS..].copy_from_slice(&angles);
        let movement = PointToPoint::plan(self.at.map(MotionState::at_rest), target, &self.limits).unwrap();
        let ticks = (movement.duration * CYCLES_PER_SECOND as f64).ceil() as u64;
        for tick in 1..=ticks {
            self.step(&movement.at(seconds(tick).min(movement.duration)));
            look(self);
        }
        self.at = target;
    }

    /// Stays for some ticks.
    pub fn stay(&mut self, ticks: u64) {
        (0..ticks).for_each(|_| self.step(&self.at.map(MotionState::at_rest)));
    }

    fn step(&mut self, joints: &[MotionState; ROBOT_JOINTS]) {
        let mut command: Box<Command> = zeroed_box();
        for (joint, state) in joints.iter().enumerate() {
            command.position[joint] = state.position;
        }
        command.header =
            Header { layout: LAYOUT, sequence: self.tick, cycle: self.tick, ..Header::default() };
        self.tick += 1;
        let Out { sample, truth, state } = &mut self.out;
        self.world.step(self.tick, Some(&command), sample, truth, state);
        for joint in 0..ARM_JOINTS {
            let off = (self.world.joints.position[joint] - command.position[joint]).abs();
            self.deviation = self.deviation.max(off);
        }
        // Commands are followed but where the arm is held away from its setpoints.
        let drive = &self.out.sample.drive;
        let follows = drive.mode == DriveMode::Following as u32;
        assert!(
            follows || self.deviation > super::safety().drive.tracking_error,
            "tick {}: {drive:?}",
            self.tick
        );
    }

    /// Where the part is in the palm.
    pub fn in_hand(&self) -> InHand {
        let palm = self.world.hand.palm(&self.world.joints.position);
        let back = palm.orientation.inverse();
        InHand {
            place: back * (self.world.parts.position(0) - palm.grasp_point),
            turn: back * self.world.parts.orientation(0),
        }
    }

    /// Takes the part from where it is thought to be, its axis along `axis`, and lifts it. Tells whether it was held
    /// before it was lifted.
    pub fn pick(&mut self, thought: DVec3, axis: DVec3) -> bool {
        let (high, _) = self.reach(thought + BACK * axis, axis);
        self.go(&high, Fingers::Open);
        for back in [BACK].iter().chain(&NEARER) {
            let (nearer, _) = self.reach_from(*back, thought, axis, |goal| goal);
            self.go(&nearer, Fingers::Open);
        }
        let (_, at) = self.reach(thought, axis);
        self.go(&at, Fingers::Open);
        self.go(&at, Fingers::Closed);
        self.stay(100);
        let held = self.holds();
        let (lifted, _) = self.reach(thought, axis);
        self.go(&lifted, Fingers::Closed);
        held
    }

    /// Brings the held part to `place`, its axis along `axis`, and lets it go there. Tells where it was just before.
    pub fn put(&mut self, place: DVec3, axis: DVec3) -> (DVec3, DQuat) {
        for back in [BACK].iter().chain(&NEARER) {
            let (nearer, _) = self.bring(*back, place, axis);
            self.go(&nearer, Fingers::Closed);
        }
        let (before, at) = self.reach_from(BACK, place, axis, |goal| goal);
        self.go(&at, Fingers::Closed);
        let brought = (self.world.parts.position(0), self.world.parts.orientation(0));
        self.go(&at, Fingers::Open);
        self.go(&before, Fingers::Open);
        self.stay(300);
        brought
    }

    /// The same, but with the held part itself, not the hand that should have it, where it is to be.
    pub fn put_part(&mut self, place: DVec3, axis: DVec3) -> (DVec3, DQuat) {
        let (mut hand_place, mut hand_axis) = (place, axis);
        for _ in 0..3 {
            let (before, _) = self.reach(hand_place, hand_axis);
            self.go(&before, Fingers::Closed);
            self.stay(100);
            let parts = &self.world.parts;
            let own = parts.orientation(0) * DVec3::Z;
            hand_place += place + BACK * hand_axis - parts.position(0);
            hand_axis = DQuat::from_rotation_arc(own, axis) * hand_axis;
        }
        self.put(hand_place, hand_axis)
    }

    /// Whether the robot has the part.
    pub fn holds(&self) -> bool {
        self.world.simulation.robot.held.get() == Some(0)
    }

    /// Pulls at the part from now on, N.
    pub fn pull(&mut self, force: DVec3) {
        if let SimulatedRobot::Physics(simulation) = &mut self.world.robot {
            simulation.pull(0, force);
        }
    }

    /// Kills the world, and lets another one go on from what it remembered.
    pub fn kill(&mut self) {
        let task = self.world.task.clone();
        self.world = World::new(&task, &self.robot, settings(&self.scenario)).unwrap();
        self.world.resume(&self.out.state).unwrap();
    }
}

fn settings(scenario: &Scenario) -> Settings {
    super::settings(1, Partner::Script(scenario.clone()), WorldMode::Physics)
}
