use super::{Out, config};
use crate::body::Body;
use crate::{BodyKind, Partner, Settings, World};
use bytemuck::zeroed_box;
use coact_joint_task::{Agent, Task};
use coact_messages::{ARM_JOINTS, Command};
use coact_robot::{
    HandGoal, JointLimits, MotionState, Movement, Posture, PostureSearch, ROBOT_JOINTS, Robot,
};
use glam::{DQuat, DVec3};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A robot in the physics world with one part on the table, moved posture by posture.
pub(super) struct Manipulator {
    pub world: World,
    pub out: Out,
    robot: Robot,
    limits: [JointLimits; ROBOT_JOINTS],
    at: [f64; ROBOT_JOINTS],
    tick: u64,
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
        let mut task = Task::load(&config("tasks/toy-vehicle.toml")).unwrap();
        let index = task.kinds.iter().position(|known| known.name == kind).unwrap();
        task.parts.retain(|part| part.kind == index);
        task.parts.truncate(1);
        (task.parts[0].at, task.parts[0].workspace) = (at, Agent::Robot);
        let settings = Settings { seed: 1, partner: Partner::Synthetic, body: BodyKind::Physics };
        let world = World::new(&task, &robot, settings).unwrap();
        let mut at = [0.0; ROBOT_JOINTS];
        at[..ARM_JOINTS].copy_from_slice(&robot.park);
        let limits = robot.limits();
        Self { world, out: Out::new(), robot, limits, at, tick: 0, deviation: 0.0 }
    }

    /// One that has taken a part of `kind` and holds it above the table; it took the part for lying up to 3 mm beside.
    pub fn holding(kind: &str, seed: u64) -> Self {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut any = |low: f64, high: f64| random.random_range(low..high);
        let at = [any(-0.52, -0.32), any(0.50, 0.72)];
        let mut robot = Self::new(kind, at);
        robot.stay(50);
        let table = robot.world.task.scene.table_height;
        robot.pick(DVec3::new(at[0] + any(-0.003, 0.003), at[1] + any(-0.003, 0.003), table));
        robot
    }

    /// Shape and width of the part, m.
    fn part(&self) -> (f64, f64) {
        let kind = &self.world.task.kinds[self.world.parts.kind(0)];
        (kind.shape.height(), kind.width)
    }

    /// Postures for gripping the part when its frame is at `place` with its axis along `axis`.
    pub fn reach(&self, place: DVec3, axis: DVec3) -> (Posture, Posture) {
        let turn = DQuat::from_rotation_arc(DVec3::Z, axis);
        let turn = UnitQuaternion::from_quaternion(Quaternion::new(turn.w, turn.x, turn.y, turn.z));
        let frame = Isometry3::from_parts(Translation3::new(place.x, place.y, place.z), turn);
        let (height, width) = self.part();
        let goal = HandGoal::grip(&frame, height, 0, 0.15, self.world.task.scene.table_height);
        let deeper = self.robot.hand.grasp_distance - self.robot.hand.grasp(width, 0.0).depth;
        let goal = HandGoal { point: goal.point + goal.approach * deeper, ..goal };
        let from: Posture = self.at[..ARM_JOINTS].try_into().unwrap();
        let reach = PostureSearch::complete(&self.robot, &goal, &from).unwrap();
        (reach.before, reach.at)
    }

    /// Moves to an arm posture with the fingers open around the part, or closed on it.
    pub fn go(&mut self, arm: &Posture, fingers: Fingers) {
        self.watch(arm, fingers, |_| {});
    }

    /// The same; `look` sees every tick.
    pub fn watch(&mut self, arm: &Posture, fingers: Fingers, mut look: impl FnMut(&Self)) {
        let width = self.part().1;
        let gap = match fingers {
            Fingers::Open => 0.01,
            Fingers::Closed => -0.3 * width,
        };
        let mut target = [0.0; ROBOT_JOINTS];
        target[..ARM_JOINTS].copy_from_slice(arm);
        target[ARM_JOINTS..].copy_from_slice(&self.robot.hand.grasp(width, gap).angles);
        let movement = Movement::plan(self.at.map(MotionState::at_rest), target, &self.limits).unwrap();
        let ticks = (movement.duration * 1e3).ceil() as u64;
        for tick in 1..=ticks {
            self.step(&movement.at((tick as f64 * 1e-3).min(movement.duration)));
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
            command.velocity[joint] = state.velocity;
        }
        self.tick += 1;
        let Out { sample, truth, state } = &mut self.out;
        self.world.step(self.tick, Some(&command), sample, truth, state);
        for joint in 0..ARM_JOINTS {
            let off = (self.world.joints.position[joint] - command.position[joint]).abs();
            self.deviation = self.deviation.max(off);
        }
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

    /// Takes the part from the table where it is thought to lie, and lifts it.
    pub fn pick(&mut self, thought: DVec3) {
        let (before, at) = self.reach(thought, DVec3::Z);
        self.go(&before, Fingers::Open);
        self.go(&at, Fingers::Open);
        self.go(&at, Fingers::Closed);
        self.stay(100);
        self.go(&before, Fingers::Closed);
    }

    /// Brings the held part to `place`, its axis along `axis`, and lets it go there.
    pub fn put(&mut self, place: DVec3, axis: DVec3) {
        let (before, at) = self.reach(place, axis);
        self.go(&before, Fingers::Closed);
        self.go(&at, Fingers::Closed);
        self.go(&at, Fingers::Open);
        self.go(&before, Fingers::Open);
        self.stay(300);
    }

    /// Whether the robot has the part.
    pub fn holds(&self) -> bool {
        self.world.memory.robot.held.get() == Some(0)
    }

    /// Pulls at the part from now on, N.
    pub fn pull(&mut self, force: DVec3) {
        if let Body::Physics(body) = &mut self.world.body {
            body.pull(0, force);
        }
    }

    /// Kills the world, and lets another one go on from what it remembered.
    pub fn kill(&mut self) {
        let settings = Settings { seed: 1, partner: Partner::Synthetic, body: BodyKind::Physics };
        self.world = World::new(&self.world.task.clone(), &self.robot, settings).unwrap();
        self.world.resume(&self.out.state);
    }
}
