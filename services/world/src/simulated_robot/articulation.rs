use super::Joints;
use super::shapes::{Layer, collider, pose};
use crate::WorldError;
use coact_messages::{ARM_JOINTS, Command};
use coact_robot::{ROBOT_JOINTS, Robot, isometry};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use rapier3d::prelude::*;
use std::collections::HashMap;

/// Motors, acceleration based: stiffness 1/s² and damping 1/s. The velocity is fed forward.
const ARM: (f32, f32) = (40_000.0, 400.0);
/// The same of the fingers: soft enough that a part stops them before their effort is spent.
const HAND: (f32, f32) = (10_000.0, 200.0);
/// Rotor inertia of every joint, kg m²: keeps the lightest links well conditioned.
const ARMATURE: f32 = 1e-3;
/// Friction coefficient of the finger pads.
const PAD: f32 = 1.0;

/// The robot's arm and hand as a multibody: a position motor in each joint, within the joint's effort; a joint that
/// mimics another is coupled to it as by a gear.
#[derive(Debug, Clone)]
pub(super) struct Articulation {
    joints: Vec<DrivenJoint>,
    /// Colliders of the hand, and which finger each belongs to; none: to the palm.
    pub shapes: Vec<(ColliderHandle, Option<usize>)>,
}

#[derive(Debug, Clone)]
struct DrivenJoint {
    handle: MultibodyJointHandle,
    name: String,
    /// Joint (message order) that it is, or that it mimics.
    source: usize,
    /// Whether it is that joint itself.
    own: bool,
    /// Largest torque of its motor, Nm.
    effort: f32,
    /// The URDF joint that it is geared to, and its angle for each rad of that.
    gear: Option<(String, f64)>,
}

/// Where a link is: on which body, and its pose in that body's frame.
type Place = (RigidBodyHandle, Isometry3<f64>);

impl Articulation {
    /// Builds bodies, colliders and joints from the robot's URDF.
    ///
    /// # Errors
    /// [`WorldError::Scene`] when a joint is neither fixed nor one that the messages know or mimic.
    pub fn build(world: &mut PhysicsWorld, robot: &Robot) -> Result<Self, WorldError> {
        let model = robot.urdf.model();
        let mut places: HashMap<&str, Place> = HashMap::new();
        let children: Vec<&str> = model.joints.iter().map(|joint| joint.child.link.as_str()).collect();
        for link in model.links.iter().filter(|link| !children.contains(&link.name.as_str())) {
            let root = world.insert_body(RigidBodyBuilder::fixed());
            places.insert(&link.name, (root, Isometry3::identity()));
            furnish(world, link, &places[link.name.as_str()], Layer::Arm);
        }
        let (mut joints, mut of_hand) = (Vec::<DrivenJoint>::new(), Vec::new());
        let mut waiting: Vec<&urdf_rs::Joint> = model.joints.iter().collect();
        while let Some(next) =
            waiting.iter().position(|joint| places.contains_key(joint.parent.link.as_str()))
        {
            let joint = waiting.swap_remove(next);
            let (body, within) = places[joint.parent.link.as_str()];
            let origin = within * isometry(&joint.origin);
            let place = if joint.joint_type == urdf_rs::JointType::Fixed {
                (body, origin)
            } else {
                let child = world.insert_body(RigidBodyBuilder::dynamic().can_sleep(false));
                joints.push(drive(world, robot, joint, (body, child), origin)?);
                (child, Isometry3::identity())
            };
            places.insert(&joint.child.link, place);
            if let Some(link) = model.links.iter().find(|link| link.name == joint.child.link) {
                let on_hand = robot.urdf.chain(None, &link.name).is_ok_and(|(joints, _)| joints.len() >= 7);
                let layer = if on_hand { Layer::Hand } else { Layer::Arm };
                let shapes = furnish(world, link, &place, layer);
                let moved = joints.last().filter(|_| joint.joint_type != urdf_rs::JointType::Fixed);
                let finger = moved.and_then(DrivenJoint::finger);
                if on_hand {
                    of_hand.extend(shapes.into_iter().map(|shape| (shape, finger)));
                }
            }
        }
        let built = Self { joints, shapes: of_hand };
        built.gear(world);
        Ok(built)
    }

    /// Couples the joints that mimic others, and gives every joint its rotor.
    fn gear(&self, world: &mut PhysicsWorld) {
        let link = |world: &PhysicsWorld, name: &str| {
            let joint = self.joints.iter().find(|joint| joint.name == name)?;
            world.multibody_joints.get(joint.handle).map(|(_, id)| id)
        };
        let couplings: Vec<_> = self
            .joints
            .iter()
            .filter_map(|joint| {
                let (to, factor) = joint.gear.as_ref()?;
                let axis = JointAxis::AngX as usize;
                Some(MultibodyDofCoupling {
                    link1: link(world, to)?,
                    dof1: 0,
                    axis1: axis,
                    link2: link(world, &joint.name)?,
                    dof2: 0,
                    axis2: axis,
                    coeff: *factor as f32,
                    offset: 0.0,
                })
            })
            .collect();
        if let Some(body) = self.multibody(world) {
            body.armature_mut().fill(ARMATURE);
            body.set_self_contacts_enabled(false);
            couplings.into_iter().for_each(|coupling| body.add_dof_coupling(coupling));
        }
    }

    fn multibody<'a>(&self, world: &'a mut PhysicsWorld) -> Option<&'a mut Multibody> {
        let first = self.joints.first()?;
        world.multibody_joints.get_mut(first.handle).map(|(body, _)| body)
    }

    /// Puts the joints where they are said to be; the motors hold them there until there is a command.
    pub fn place(&self, world: &mut PhysicsWorld, joints: &Joints) {
        let PhysicsWorld { multibody_joints, bodies, .. } = world;
        for driven in &self.joints {
            let Some((body, id)) = multibody_joints.get_mut(driven.handle) else { continue };
            let (ndofs, Some(link)) = (body.ndofs(), body.link(id)) else { continue };
            let at = link.assembly_id();
            let mut displacement = vec![0.0; ndofs];
            let factor = driven.factor();
            let wanted = factor * joints.position[driven.source];
            displacement[at] = wanted as f32 - link.joint().coords()[3];
            body.apply_displacements(&displacement);
            let gains = driven.gains();
            if let Some(link) = body.link_mut(id).filter(|_| driven.gear.is_none()) {
                link.joint.data.set_motor(JointAxis::AngX, wanted as f32, 0.0, gains.0, gains.1);
            }
            body.generalized_velocity_mut()[at] = (factor * joints.velocity[driven.source]) as f32;
            body.forward_kinematics(bodies, false);
            body.update_rigid_bodies(bodies, true);
        }
    }

    /// Gives every motor its setpoint.
    pub fn command(&self, world: &mut PhysicsWorld, command: &Command) {
        for driven in self.driven() {
            let Some((body, id)) = world.multibody_joints.get_mut(driven.handle) else { continue };
            let Some(link) = body.link_mut(id) else { continue };
            let gains = driven.gains();
            let motor = (command.position[driven.source] as f32, command.velocity[driven.source] as f32);
            link.joint.data.set_motor(JointAxis::AngX, motor.0, motor.1, gains.0, gains.1);
        }
    }

    /// Lets every motor carry the robot's own weight, as far as its effort goes; what is left of the effort is for
    /// following the setpoint.
    pub fn carry_own_weight(&self, world: &mut PhysicsWorld) {
        let PhysicsWorld { multibody_joints, bodies, gravity, .. } = world;
        let Some((body, _)) = self.joints.first().and_then(|first| multibody_joints.get(first.handle)) else {
            return;
        };
        for link in body.links() {
            if let Some(body) = bodies.get_mut(link.rigid_body_handle()) {
                body.reset_torques(false);
            }
        }
        for driven in self.driven() {
            let Some((body, id)) = multibody_joints.get_mut(driven.handle) else { continue };
            let torque = -weight_on(body, id, bodies, *gravity).clamp(-driven.effort, driven.effort);
            let parent = body.link(id).and_then(|link| link.parent_id()).and_then(|parent| body.link(parent));
            let parent = parent.map(|parent| parent.rigid_body_handle());
            let Some(link) = body.link_mut(id) else { continue };
            link.joint.data.set_motor_max_force(JointAxis::AngX, driven.effort - torque.abs());
            let child = link.rigid_body_handle();
            let axis = link.joint.data.local_axis2();
            let Some(axis) = bodies.get(child).map(|body| *body.rotation() * axis) else { continue };
            for (body, torque) in [(Some(child), torque), (parent, -torque)] {
                if let Some(body) = body.and_then(|body| bodies.get_mut(body)) {
                    body.add_torque(torque * axis, false);
                }
            }
        }
    }

    fn driven(&self) -> impl Iterator<Item = &DrivenJoint> {
        self.joints.iter().filter(|driven| driven.gear.is_none())
    }

    /// The body that the palm is on.
    pub fn palm(&self, world: &PhysicsWorld) -> Option<RigidBodyHandle> {
        let last = self.joints.iter().find(|joint| joint.source == ARM_JOINTS - 1)?;
        let (body, id) = world.multibody_joints.get(last.handle)?;
        body.link(id).map(|link| link.rigid_body_handle())
    }

    /// Reads joint positions and velocities.
    pub fn read(&self, world: &PhysicsWorld, joints: &mut Joints) {
        for driven in self.joints.iter().filter(|driven| driven.own) {
            let Some((body, id)) = world.multibody_joints.get(driven.handle) else { continue };
            let Some(link) = body.link(id) else { continue };
            joints.position[driven.source] = f64::from(link.joint().coords()[3]);
            joints.velocity[driven.source] = f64::from(body.joint_velocity(link)[0]);
        }
    }
}

impl DrivenJoint {
    /// Stiffness, 1/s², and damping, 1/s, of its motor.
    fn gains(&self) -> (f32, f32) {
        if self.source < ARM_JOINTS { ARM } else { HAND }
    }

    /// The finger whose base or tip it is.
    fn finger(&self) -> Option<usize> {
        self.source.checked_sub(ARM_JOINTS + 1).map(|joint| joint % 3)
    }

    /// Angle for each rad of its source.
    fn factor(&self) -> f64 {
        if self.own { 1.0 } else { self.gear.as_ref().map_or(1.0, |(_, factor)| *factor) }
    }
}

/// Torque of the weight of all links about a joint, Nm.
fn weight_on(body: &Multibody, joint: usize, bodies: &RigidBodySet, gravity: Vector) -> f32 {
    let Some(column) = body.link(joint).map(|link| link.assembly_id()) else { return 0.0 };
    let links = body.links().enumerate().filter_map(|(id, link)| {
        let weight = bodies.get(link.rigid_body_handle())?.mass() * gravity;
        let way = body.body_jacobian(id).column(column);
        Some(weight.x * way[0] + weight.y * way[1] + weight.z * way[2])
    });
    links.sum()
}

/// Makes a revolute joint, with its motor unless it is geared to another.
fn drive(
    world: &mut PhysicsWorld,
    robot: &Robot,
    joint: &urdf_rs::Joint,
    (parent, child): (RigidBodyHandle, RigidBodyHandle),
    origin: Isometry3<f64>,
) -> Result<DrivenJoint, WorldError> {
    let fault = |message: &str| WorldError::Robot { joint: joint.name.clone(), message: message.to_owned() };
    let named = |name: &str| (0..ROBOT_JOINTS).find(|&index| name_of(robot, index) == name);
    let own = named(&joint.name);
    let gear = robot.urdf.mimicked(&joint.name).map(|(other, factor, _)| (other, factor));
    let mimicked = gear.as_ref().and_then(|(name, _)| named(name));
    let source = own.or(mimicked).ok_or_else(|| {
        fault("is not fixed, not in the robot file, and mimics no joint that is; name it there")
    })?;
    let axis = Vector3::from(joint.axis.xyz.0);
    let align = UnitQuaternion::rotation_between(&Vector3::x(), &axis)
        .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::PI));
    let effort = joint.limit.effort as f32;
    let data = GenericJointBuilder::new(JointAxesMask::LOCKED_REVOLUTE_AXES)
        .local_frame1(pose(&(origin * align)))
        .local_frame2(pose(&Isometry3::from_parts(Default::default(), align)));
    let motor = |data: GenericJointBuilder| {
        data.motor_model(JointAxis::AngX, MotorModel::AccelerationBased)
            .set_motor(JointAxis::AngX, 0.0, 0.0, ARM.0, ARM.1)
            .motor_max_force(JointAxis::AngX, effort)
    };
    let data = if gear.is_none() { motor(data) } else { data };
    let handle = world
        .insert_multibody_joint(parent, child, data.build())
        .ok_or_else(|| fault("closes a loop; expected a tree of links"))?;
    Ok(DrivenJoint { handle, name: joint.name.clone(), source, own: own.is_some(), effort, gear })
}

fn name_of(robot: &Robot, index: usize) -> &str {
    match index.checked_sub(7) {
        None => &robot.arm().joints[index].name,
        Some(index) => &robot.hand.joints[index].name,
    }
}

/// Gives a link's mass and shapes to the body that it is on, and tells the shapes.
fn furnish(
    world: &mut PhysicsWorld,
    link: &urdf_rs::Link,
    (body, within): &Place,
    layer: Layer,
) -> Vec<ColliderHandle> {
    if let Some(body) = world.bodies.get_mut(*body) {
        let mass = body.mass_properties().additional_local_mprops.as_deref();
        let known = match mass {
            Some(RigidBodyAdditionalMassProps::MassProps(mass)) => *mass,
            _ => MassProperties::default(),
        };
        body.set_additional_mass_properties(known + mass_properties(&link.inertial, within), false);
    }
    let shapes = link.collision.iter().filter_map(|shape| Some((collider(&shape.geometry)?, &shape.origin)));
    shapes
        .map(|((shape, turn), origin)| {
            let place = within * isometry(origin) * turn;
            let shape = shape.density(0.0).friction(PAD).collision_groups(layer.groups());
            world.insert_collider(shape.position(pose(&place)), Some(*body))
        })
        .collect()
}

fn mass_properties(inertial: &urdf_rs::Inertial, within: &Isometry3<f64>) -> MassProperties {
    let place = within * isometry(&inertial.origin);
    let inertia = &inertial.inertia;
    let tensor = nalgebra::Matrix3::new(
        inertia.ixx,
        inertia.ixy,
        inertia.ixz,
        inertia.ixy,
        inertia.iyy,
        inertia.iyz,
        inertia.ixz,
        inertia.iyz,
        inertia.izz,
    );
    let turn = place.rotation.to_rotation_matrix();
    let turned = (turn * tensor * turn.transpose()).map(|entry| entry as f32);
    let matrix = Matrix::from_cols_array(&turned.as_slice().try_into().unwrap_or([0.0; 9]));
    let centre = place.translation.vector.map(|entry| entry as f32);
    MassProperties::with_inertia_matrix(
        Vector::new(centre.x, centre.y, centre.z),
        inertial.mass.value as f32,
        matrix,
    )
}
