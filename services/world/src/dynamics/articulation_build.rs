//! From a robot's URDF to bodies, colliders and joints.

use super::articulation::Articulation;
use super::driven_joint::DrivenJoint;
use super::inverse_dynamics::InverseDynamics;
use super::layer::Layer;
use super::link_body::{Place, furnish_link};
use crate::WorldError;
use coact_messages::ARM_JOINTS;
use coact_robot::{MotionState, Robot, isometry};
use nalgebra::Isometry3;
use rapier3d::prelude::*;
use std::collections::HashMap;

/// Rotor inertia of every joint, kg m²: keeps the lightest links well conditioned.
const ARMATURE: f64 = 1e-3;

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
            furnish_link(world, link, &places[link.name.as_str()], Layer::Arm);
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
                joints.push(DrivenJoint::build(world, robot, joint, (body, child), origin)?);
                (child, Isometry3::identity())
            };
            places.insert(&joint.child.link, place);
            if let Some(link) = model.links.iter().find(|link| link.name == joint.child.link) {
                let on_hand = robot.urdf.chain(None, &link.name).is_ok_and(|(joints, _)| joints.len() >= 7);
                let layer = if on_hand { Layer::Hand } else { Layer::Arm };
                let shapes = furnish_link(world, link, &place, layer);
                let moved = joints.last().filter(|_| joint.joint_type != urdf_rs::JointType::Fixed);
                let finger = moved.and_then(DrivenJoint::finger);
                if on_hand {
                    of_hand.extend(shapes.into_iter().map(|shape| (shape, finger)));
                }
            }
        }
        let setpoints = [MotionState::at_rest(0.0); ARM_JOINTS];
        let dynamics = InverseDynamics::default();
        let built = Self { joints, shapes: of_hand, setpoints, dynamics };
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
                    coeff: *factor,
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
}
