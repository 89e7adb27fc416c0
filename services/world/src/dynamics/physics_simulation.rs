use super::articulation::Articulation;
use super::clasp::Clasp;
use super::colliders::{PART_FRICTION, part_collider};
use super::contacts::Contacts;
use super::fixtures::insert_fixtures;
use super::force_sensor::ForceSensor;
use super::influence::Influence;
use super::joints::Joints;
use super::layer::Layer;
use super::measured_grip::MeasuredGrip;
use super::person_grip::PersonGrip;
use crate::WorldError;
use crate::parts::Parts;
use coact_joint_task::Task;
use coact_messages::PartState;
use coact_period::PERIOD_S;
use coact_person::Holder;
use coact_robot::Robot;
use glam::{DQuat, DVec3};
use rapier3d::prelude::*;

/// Gravity, m/s².
const GRAVITY: f64 = 9.81;
/// Substeps of the solver in each step of 1 ms. Two, at half the cost of the engine's four, keep resting parts within
/// 5 mm of their places.
const SUBSTEPS: usize = 2;
/// Size of the things that are handled, m: the engine scales its tolerances by it, and lets them overlap by 0.5 % of it.
const SIZE: f64 = 0.1;
/// Natural frequency of contacts between things that move, Hz: as the engine's of contacts with what stands still. With its 30 Hz
/// a finger that holds a nut sinks 3 mm into it, and its tip meets the axle on which the nut belongs.
const CONTACT_FREQUENCY: f64 = 60.0;
/// What fraction of the way to its exact place a mounted part goes in a step: a socket centres it within some tenths of a second, at
/// less than 30 mm/s. One that was there at once threw the fingers that had just let it go.
const SETTLING: f64 = PERIOD_S / 0.3;
/// A mounted part that is as near as this is in its place, m and rad. Not sensitive.
const SETTLED: (f64, f64) = (1e-5, 1e-3);

/// Rigid-body dynamics of table, base, parts and robot; one step is one tick.
///
/// Mounted parts stand fast, and all others are loose: the person's hand pulls the part that it has, as hard as fingers can, and the
/// robot's fingers hold a part by contact and friction.
pub(crate) struct PhysicsSimulation {
    world: PhysicsWorld,
    articulation: Articulation,
    parts: Vec<RigidBodyHandle>,
    /// Parts as the last step left them: what differs now was placed by someone else.
    left: Vec<PartState>,
    person: RigidBodyHandle,
    person_grip: Option<PersonGrip>,
    forces: ForceSensor,
    grip: MeasuredGrip,
    outside: DVec3,
    clasp: Option<Clasp>,
    /// The part at which the person pulls.
    pulled: Option<usize>,
}

impl PhysicsSimulation {
    /// Builds the scene with the parts and the joints where they are.
    ///
    /// # Errors
    /// [`WorldError`] when parts overlap each other or the base at the start, or a joint of the robot is unknown.
    pub fn new(task: &Task, robot: &Robot, joints: &Joints, parts: &Parts) -> Result<Self, WorldError> {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, 0.0, -GRAVITY);
        world.integration_parameters.dt = PERIOD_S;
        world.integration_parameters.num_solver_iterations = SUBSTEPS;
        world.integration_parameters.length_unit = SIZE;
        world.integration_parameters.contact_softness.natural_frequency = CONTACT_FREQUENCY;
        insert_fixtures(&mut world, task)?;
        let articulation = Articulation::build(&mut world, robot)?;
        let numbered = parts.all().iter().zip(1..);
        let bodies = numbered.map(|(part, number)| insert_part(&mut world, task, part, number)).collect();
        let person = world.insert_body(RigidBodyBuilder::kinematic_position_based());
        let ball = ColliderBuilder::ball(PersonGrip::HAND).collision_groups(Layer::Person.groups());
        world.insert_collider(ball, Some(person));
        let left = parts.all().to_vec();
        let mut built = Self {
            world,
            articulation,
            parts: bodies,
            left,
            person,
            person_grip: None,
            forces: ForceSensor::new(),
            grip: MeasuredGrip::NONE,
            outside: DVec3::ZERO,
            clasp: None,
            pulled: None,
        };
        built.resume(joints, parts);
        Ok(built)
    }

    /// Takes over joints and parts as they are.
    pub fn resume(&mut self, joints: &Joints, parts: &Parts) {
        self.release();
        self.person_opens();
        self.articulation.place(&mut self.world, joints);
        for (index, part) in parts.all().iter().enumerate() {
            self.put(index, part);
        }
        self.left.copy_from_slice(parts.all());
    }

    /// One step of 1 ms.
    pub fn advance(&mut self, influence: &Influence, joints: &mut Joints, parts: &mut Parts) {
        if let Some(setpoints) = influence.setpoints {
            self.articulation.command(&mut self.world, setpoints);
        }
        self.articulation.drive(&mut self.world);
        parts.settle(influence.task);
        self.follow(influence.person, parts);
        self.person_grips(parts);
        self.assign_layers(parts, influence);
        let held = influence.held.filter(|held| parts.is(*held, Holder::Robot));
        self.clasp_held(held);
        self.pull_at(held, influence.pull);
        self.world.step();
        self.articulation.read(&self.world, joints);
        self.measure(held, parts);
        if let Some(clasp) = &mut self.clasp {
            clasp.check(&mut self.world, &self.articulation, &self.grip);
        }
        self.report(parts);
    }

    /// The person's hand has the part there from now on, if nothing is in its way.
    pub fn carry(&mut self, part: usize, position: DVec3, orientation: DQuat) {
        if let Some(grip) = self.person_grip.as_mut().filter(|grip| grip.part() == part) {
            grip.carry(Pose::from_parts(position, orientation.normalize()));
        }
    }

    /// Pulls at a part from now on, N.
    #[cfg(test)]
    pub fn pull(&mut self, part: usize, force: DVec3) {
        if let Some(body) = self.world.bodies.get_mut(self.parts[part]) {
            body.reset_forces(true);
            body.add_force(force, true);
        }
    }

    /// What the fingers hold, as measured.
    pub fn grip(&self) -> MeasuredGrip {
        self.grip
    }

    /// Force on the hand and on the part that it holds, N.
    pub fn outside(&self) -> DVec3 {
        self.outside
    }

    fn measure(&mut self, held: Option<usize>, parts: &Parts) {
        let body = held.map(|held| self.parts[held]);
        let own = |part| held == Some(part) || parts.is(part, Holder::Person);
        self.forces.feel(Contacts::measure(&self.world, &self.articulation, body, own));
        let felt = self.forces.read();
        self.grip = MeasuredGrip::of(&felt);
        self.outside = felt.outside;
    }

    /// Lets the person pull at what the hand holds, as far as the grip withstands it; beyond that the part slips.
    fn pull_at(&mut self, held: Option<usize>, pull: DVec3) {
        if let Some(body) = self.pulled.take().and_then(|part| self.world.bodies.get_mut(self.parts[part])) {
            body.reset_forces(true);
        }
        let Some(held) = held.filter(|_| pull != DVec3::ZERO) else { return };
        if let Some(body) = self.world.bodies.get_mut(self.parts[held]) {
            let force = pull.clamp_length_max(self.grip.carries(held));
            body.add_force(force, true);
            self.pulled = Some(held);
        }
    }

    /// Clasps what the hand holds, and nothing else.
    fn clasp_held(&mut self, held: Option<usize>) {
        if self.clasp.map(|clasp| clasp.part()) == held {
            return;
        }
        self.release();
        let palm = held.and_then(|held| Some((held, self.articulation.palm(&self.world)?)));
        self.clasp = palm.map(|(held, palm)| Clasp::new(&mut self.world, palm, held, self.parts[held]));
    }

    fn release(&mut self) {
        if let Some(mut clasp) = self.clasp.take() {
            clasp.open(&mut self.world);
        }
    }

    /// Grips what the person's hand has, and nothing else.
    fn person_grips(&mut self, parts: &Parts) {
        let held = (0..self.parts.len()).find(|part| parts.is(*part, Holder::Person));
        if self.person_grip.map(|grip| grip.part()) != held {
            self.person_opens();
            self.person_grip = held.map(|part| PersonGrip::new(&mut self.world, part, self.parts[part]));
        }
        if let Some(grip) = &mut self.person_grip {
            grip.pull(&mut self.world);
        }
    }

    fn person_opens(&mut self) {
        if let Some(grip) = self.person_grip.take() {
            grip.open(&mut self.world);
        }
    }

    /// Says what each part touches: parts that are true to a socket enter what they are mounted in, and no others.
    fn assign_layers(&mut self, parts: &Parts, influence: &Influence) {
        for (index, part) in self.parts.iter().enumerate() {
            let layer = match () {
                () if parts.is(index, Holder::Socket) => Layer::Fixture,
                () if parts.is(index, Holder::Person) => Layer::Carried,
                () if influence.slipped == Some(index) => Layer::Slipping,
                () if parts.enters(index, influence.task) => Layer::Entering,
                () => Layer::Part,
            };
            let collider = self.world.bodies.get(*part).and_then(|body| body.colliders().first().copied());
            let collider = collider.and_then(|collider| self.world.colliders.get_mut(collider));
            if let Some(collider) = collider.filter(|known| known.collision_groups() != layer.groups()) {
                collider.set_collision_groups(layer.groups());
            }
        }
    }

    /// Hands what was placed, taken or mounted since the last step to the engine.
    fn follow(&mut self, person: DVec3, parts: &Parts) {
        for (index, part) in parts.all().iter().enumerate() {
            let left = self.left[index];
            let kind = body_type(part);
            let there = part.position == left.position && part.orientation == left.orientation;
            match kind {
                RigidBodyType::Fixed => self.settle(index, part),
                kind if there && kind == body_type(&left) => {}
                _ => self.put(index, part),
            }
            self.left[index] = *part;
        }
        if let Some(body) = self.world.bodies.get_mut(self.person) {
            body.set_next_kinematic_position(Pose::from_translation(person));
        }
    }

    /// Lets a mounted part stand fast, and centres it in its socket.
    fn settle(&mut self, index: usize, part: &PartState) {
        let (place, handle) = (pose_of(part), self.parts[index]);
        let Some(body) = self.world.bodies.get(handle) else { return };
        let stands = body.body_type() == RigidBodyType::Fixed;
        let offset = body.translation().distance(place.translation);
        let turned = body.rotation().angle_between(place.rotation);
        if stands && offset <= SETTLED.0 && turned <= SETTLED.1 {
            return;
        }
        if let Some(body) = self.world.bodies.get_mut(handle) {
            body.set_body_type(RigidBodyType::Fixed, true);
            body.set_position(body.position().lerp(&place, SETTLING), true);
        }
    }

    /// Places a part, and makes it loose or fixed as its state says.
    fn put(&mut self, index: usize, part: &PartState) {
        let Some(body) = self.world.bodies.get_mut(self.parts[index]) else { return };
        let kind = body_type(part);
        body.set_body_type(kind, true);
        body.set_position(pose_of(part), true);
        if kind == RigidBodyType::Dynamic {
            body.set_linvel(part.velocity.into(), true);
            body.set_angvel(Vector::ZERO, true);
        }
    }

    /// Where the loose parts are now. A body that the engine lost stays where it was last seen.
    fn report(&mut self, parts: &mut Parts) {
        for index in 0..self.parts.len() {
            if body_type(&parts.all()[index]) != RigidBodyType::Dynamic {
                continue;
            }
            let Some(body) = self.world.bodies.get(self.parts[index]) else { continue };
            if body.is_sleeping() {
                continue;
            }
            let (at, turn, velocity) = (body.translation(), body.rotation(), body.linvel());
            let finite = at.is_finite() && turn.is_finite() && velocity.is_finite();
            if !finite {
                let mut last = self.left[index];
                last.velocity = [0.0; 3];
                self.put(index, &last);
                continue;
            }
            parts.move_to(index, at, turn.normalize(), velocity.to_array());
            self.left[index] = parts.all()[index];
        }
    }
}

/// Makes the body of a part. Its collider carries the `number` as user data.
fn insert_part(world: &mut PhysicsWorld, task: &Task, part: &PartState, number: u128) -> RigidBodyHandle {
    let body = world.insert_body(RigidBodyBuilder::dynamic().pose(pose_of(part)));
    let kind = &task.kinds[part.kind as usize];
    let collider = part_collider(kind.shape)
        .mass(kind.mass)
        .friction(PART_FRICTION)
        .user_data(number)
        .collision_groups(Layer::Part.groups());
    world.insert_collider(collider, Some(body));
    body
}

fn body_type(part: &PartState) -> RigidBodyType {
    if part.state == Holder::Socket as u32 { RigidBodyType::Fixed } else { RigidBodyType::Dynamic }
}

fn pose_of(part: &PartState) -> Pose {
    Pose::from_parts(part.position.into(), Rotation::from_array(part.orientation).normalize())
}
