use super::Joints;
use super::shapes::{Layer, collider, pose};
use crate::WorldError;
use coact_messages::Command;
use coact_robot::{ROBOT_JOINTS, Robot};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use rapier3d::prelude::*;
use std::collections::HashMap;

/// Motors, acceleration based: stiffness 1/s² and damping 1/s. With the velocity fed forward they lag less than 1 mrad.
const STIFFNESS: f32 = 10_000.0;
const DAMPING: f32 = 200.0;
/// Rotor inertia of every joint, kg m²: keeps the lightest links well conditioned.
const ARMATURE: f32 = 1e-3;

/// The robot's arm and hand as a multibody with a position motor in each joint.
#[derive(Debug, Clone)]
pub(super) struct Articulation {
    joints: Vec<DrivenJoint>,
}

#[derive(Debug, Clone, Copy)]
struct DrivenJoint {
    handle: MultibodyJointHandle,
    /// Joint (message order) whose setpoint drives it.
    source: usize,
    factor: f64,
    /// Whether it is that joint itself, not one that mimics it.
    own: bool,
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
            furnish(world, link, &places[link.name.as_str()], robot);
        }
        let mut joints = Vec::new();
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
                let child =
                    world.insert_body(RigidBodyBuilder::dynamic().gravity_scale(0.0).can_sleep(false));
                joints.push(drive(world, robot, joint, (body, child), origin)?);
                (child, Isometry3::identity())
            };
            places.insert(&joint.child.link, place);
            if let Some(link) = model.links.iter().find(|link| link.name == joint.child.link) {
                furnish(world, link, &place, robot);
            }
        }
        let built = Self { joints };
        if let Some(body) = built.multibody(world) {
            body.armature_mut().fill(ARMATURE);
            body.set_self_contacts_enabled(false);
        }
        Ok(built)
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
            let wanted = driven.factor * joints.position[driven.source];
            displacement[at] = wanted as f32 - link.joint().coords()[3];
            body.apply_displacements(&displacement);
            if let Some(link) = body.link_mut(id) {
                link.joint.data.set_motor(JointAxis::AngX, wanted as f32, 0.0, STIFFNESS, DAMPING);
            }
            body.generalized_velocity_mut()[at] = (driven.factor * joints.velocity[driven.source]) as f32;
            body.forward_kinematics(bodies, false);
            body.update_rigid_bodies(bodies, true);
        }
    }

    /// Gives every motor its setpoint; fingers on a part stop at `finger_stop`.
    pub fn command(&self, world: &mut PhysicsWorld, command: &Command, stop: impl Fn(usize) -> f64) {
        for driven in &self.joints {
            let Some((body, id)) = world.multibody_joints.get_mut(driven.handle) else { continue };
            let Some(link) = body.link_mut(id) else { continue };
            let source = driven.source;
            let free = command.position[source] <= stop(source);
            let position = driven.factor * command.position[source].min(stop(source));
            let velocity = if free { driven.factor * command.velocity[source] } else { 0.0 };
            let motor = (position as f32, velocity as f32);
            link.joint.data.set_motor(JointAxis::AngX, motor.0, motor.1, STIFFNESS, DAMPING);
        }
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

/// Makes a revolute joint with its motor.
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
    let mimicked =
        joint.mimic.as_ref().and_then(|mimic| Some((named(&mimic.joint)?, mimic.multiplier.unwrap_or(1.0))));
    let (source, factor) = own.map(|index| (index, 1.0)).or(mimicked).ok_or_else(|| {
        fault("is not fixed, not in the robot file, and mimics no joint that is; name it there")
    })?;
    let axis = Vector3::from(joint.axis.xyz.0);
    let align = UnitQuaternion::rotation_between(&Vector3::x(), &axis)
        .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::PI));
    let data = GenericJointBuilder::new(JointAxesMask::LOCKED_REVOLUTE_AXES)
        .local_frame1(pose(&(origin * align)))
        .local_frame2(pose(&Isometry3::from_parts(Default::default(), align)))
        .motor_model(JointAxis::AngX, MotorModel::AccelerationBased)
        .set_motor(JointAxis::AngX, 0.0, 0.0, STIFFNESS, DAMPING)
        .build();
    let handle = world
        .insert_multibody_joint(parent, child, data)
        .ok_or_else(|| fault("closes a loop; expected a tree of links"))?;
    Ok(DrivenJoint { handle, source, factor, own: own.is_some() })
}

fn name_of(robot: &Robot, index: usize) -> &str {
    match index.checked_sub(7) {
        None => &robot.arm().joints[index].name,
        Some(index) => &robot.hand.joints[index].name,
    }
}

/// Gives a link's mass and shapes to the body that it is on.
///
/// What the hand does to parts follows the rules of grasping, so its links touch nothing; the arm's do.
fn furnish(world: &mut PhysicsWorld, link: &urdf_rs::Link, (body, within): &Place, robot: &Robot) {
    let on_hand = robot.urdf.chain(None, &link.name).is_ok_and(|(joints, _)| joints.len() >= 7);
    if let Some(body) = world.bodies.get_mut(*body) {
        let mass = body.mass_properties().additional_local_mprops.as_deref();
        let known = match mass {
            Some(RigidBodyAdditionalMassProps::MassProps(mass)) => *mass,
            _ => MassProperties::default(),
        };
        body.set_additional_mass_properties(known + mass_properties(&link.inertial, within), false);
    }
    for shape in link.collision.iter().filter(|_| !on_hand) {
        let Some(built) = collider(&shape.geometry) else { continue };
        let place = within * isometry(&shape.origin) * built.1;
        let collider = built.0.density(0.0).position(pose(&place)).collision_groups(Layer::Arm.groups());
        world.insert_collider(collider, Some(*body));
    }
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

fn isometry(origin: &urdf_rs::Pose) -> Isometry3<f64> {
    let ([x, y, z], [roll, pitch, yaw]) = (origin.xyz.0, origin.rpy.0);
    Isometry3::from_parts(
        nalgebra::Translation3::new(x, y, z),
        UnitQuaternion::from_euler_angles(roll, pitch, yaw),
    )
}
