use super::driven_joint::DrivenJoint;
use super::joints::Joints;
use coact_messages::{ARM_JOINTS, JOINTS};
use coact_robot::MotionState;
use rapier3d::prelude::*;

/// The robot's arm and hand as a multibody: a position motor in each joint, within the joint's effort; a joint that
/// mimics another is coupled to it as by a gear.
#[derive(Debug, Clone)]
pub(super) struct Articulation {
    pub joints: Vec<DrivenJoint>,
    /// Colliders of the hand, and which finger each belongs to; none: to the palm.
    pub shapes: Vec<(ColliderHandle, Option<usize>)>,
}

impl Articulation {
    pub fn multibody<'a>(&self, world: &'a mut PhysicsWorld) -> Option<&'a mut Multibody> {
        let first = self.joints.first()?;
        world.multibody_joints.get_mut(first.handle).map(|(body, _)| body)
    }

    /// Puts the joints where they are said to be; the motors hold them there until the drive has started.
    pub fn place(&self, world: &mut PhysicsWorld, joints: &Joints) {
        let PhysicsWorld { multibody_joints, bodies, .. } = world;
        for driven in &self.joints {
            let Some((body, id)) = multibody_joints.get_mut(driven.handle) else { continue };
            let (ndofs, Some(link)) = (body.ndofs(), body.link(id)) else { continue };
            let at = link.assembly_id();
            let mut displacement = vec![0.0; ndofs];
            let factor = driven.factor();
            let wanted = factor * joints.position[driven.source];
            displacement[at] = wanted - link.joint().coords()[3];
            body.apply_displacements(&displacement);
            let gains = driven.gains();
            if let Some(link) = body.link_mut(id).filter(|_| driven.gear.is_none()) {
                link.joint.data.set_motor(JointAxis::AngX, wanted, 0.0, gains.0, gains.1);
            }
            body.generalized_velocity_mut()[at] = factor * joints.velocity[driven.source];
            body.forward_kinematics(bodies, false);
            body.update_rigid_bodies(bodies, true);
        }
    }

    /// Gives every motor its setpoint.
    pub fn command(&self, world: &mut PhysicsWorld, setpoints: &[MotionState; JOINTS]) {
        for driven in self.driven() {
            let Some((body, id)) = world.multibody_joints.get_mut(driven.handle) else { continue };
            let Some(link) = body.link_mut(id) else { continue };
            let gains = driven.gains();
            let setpoint = &setpoints[driven.source];
            let motor = (setpoint.position, setpoint.velocity);
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
        for driven in self.joints.iter().filter(|driven| driven.is_source) {
            let Some((body, id)) = world.multibody_joints.get(driven.handle) else { continue };
            let Some(link) = body.link(id) else { continue };
            joints.position[driven.source] = link.joint().coords()[3];
            joints.velocity[driven.source] = body.joint_velocity(link)[0];
        }
    }
}

/// Torque of the weight of all links about a joint, Nm.
fn weight_on(body: &Multibody, joint: usize, bodies: &RigidBodySet, gravity: Vector) -> f64 {
    let Some(column) = body.link(joint).map(|link| link.assembly_id()) else { return 0.0 };
    let links = body.links().enumerate().filter_map(|(id, link)| {
        let weight = bodies.get(link.rigid_body_handle())?.mass() * gravity;
        let way = body.body_jacobian(id).column(column);
        Some(weight.x * way[0] + weight.y * way[1] + weight.z * way[2])
    });
    links.sum()
}
