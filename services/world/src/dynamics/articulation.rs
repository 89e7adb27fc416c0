use super::driven_joint::DrivenJoint;
use super::inverse_dynamics::InverseDynamics;
use super::joints::Joints;
use coact_messages::{ARM_JOINTS, JOINTS};
use coact_robot::MotionState;
use rapier3d::prelude::*;

/// The robot's arm and hand as a multibody. The arm's joints are driven by torques, as a real one's are: what the wanted
/// acceleration of the whole arm takes (computed torque: Siciliano et al., Robotics, 2009, section 8.5.2). Each finger's joint
/// has a soft position motor; a joint that mimics another is coupled to it as by a gear. All within the joints' efforts.
#[derive(Debug, Clone)]
pub(super) struct Articulation {
    pub joints: Vec<DrivenJoint>,
    /// Colliders of the hand, and which finger each belongs to; none: to the palm.
    pub shapes: Vec<(ColliderHandle, Option<usize>)>,
    /// Where the arm's joints are to be, and how they are to move.
    pub setpoints: [MotionState; ARM_JOINTS],
    /// What their motion takes.
    pub dynamics: InverseDynamics,
}

impl Articulation {
    pub fn multibody<'a>(&self, world: &'a mut PhysicsWorld) -> Option<&'a mut Multibody> {
        let first = self.joints.first()?;
        world.multibody_joints.get_mut(first.handle).map(|(body, _)| body)
    }

    /// Puts the joints where they are said to be, to be held there until the drive has started.
    pub fn place(&mut self, world: &mut PhysicsWorld, joints: &Joints) {
        self.setpoints = std::array::from_fn(|joint| MotionState::at_rest(joints.position[joint]));
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
            if let Some(link) = body.link_mut(id) {
                driven.aim_motor(link, wanted, 0.0);
            }
            body.generalized_velocity_mut()[at] = factor * joints.velocity[driven.source];
            body.forward_kinematics(bodies, false);
            body.update_rigid_bodies(bodies, true);
        }
    }

    /// Takes over every joint's setpoint.
    pub fn command(&mut self, world: &mut PhysicsWorld, setpoints: &[MotionState; JOINTS]) {
        self.setpoints.copy_from_slice(&setpoints[..ARM_JOINTS]);
        for driven in &self.joints {
            let Some((body, id)) = world.multibody_joints.get_mut(driven.handle) else { continue };
            let Some(link) = body.link_mut(id) else { continue };
            let MotionState { position, velocity, .. } = setpoints[driven.source];
            driven.aim_motor(link, position, velocity);
        }
    }

    /// Drives the joints for one step: the arm's by the torques that its setpoints take, the fingers' by what holds them where they
    /// are on the moving arm; what is left of a finger's effort is its motor's.
    pub fn drive(&mut self, world: &mut PhysicsWorld) {
        self.solve(world);
        let PhysicsWorld { multibody_joints, bodies, .. } = world;
        let Some((body, _)) = self.joints.first().and_then(|first| multibody_joints.get(first.handle)) else {
            return;
        };
        for link in body.links() {
            if let Some(body) = bodies.get_mut(link.rigid_body_handle()) {
                body.reset_torques(false);
            }
        }
        for driven in self.joints.iter().filter(|driven| driven.gear.is_none()) {
            let Some((body, id)) = multibody_joints.get_mut(driven.handle) else { continue };
            let torque = self.dynamics.torque(body, id).clamp(-driven.effort, driven.effort);
            let parent = body.link(id).and_then(|link| link.parent_id()).and_then(|parent| body.link(parent));
            let parent = parent.map(|parent| parent.rigid_body_handle());
            let Some(link) = body.link_mut(id) else { continue };
            driven.limit_motor(link, driven.effort - torque.abs());
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

    /// What the motion takes in which each of the arm's joints follows its setpoint, and the fingers keep their shape.
    fn solve(&mut self, world: &PhysicsWorld) {
        let Self { joints, setpoints, dynamics, .. } = self;
        let Some((body, _)) = joints.first().and_then(|first| world.multibody_joints.get(first.handle))
        else {
            return;
        };
        dynamics.clear(body);
        for driven in joints.iter().filter(|driven| driven.source < ARM_JOINTS && driven.gear.is_none()) {
            let Some((_, id)) = world.multibody_joints.get(driven.handle) else { continue };
            let Some(link) = body.link(id) else { continue };
            let (position, velocity) = (link.joint().coords()[3], body.joint_velocity(link)[0]);
            dynamics.accelerate(link, driven.acceleration(&setpoints[driven.source], position, velocity));
        }
        dynamics.solve(body, &world.bodies, world.gravity);
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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use coact_period::PERIOD_S;
    use coact_robot::Robot;
    use std::path::Path;

    /// Our robot's arm and hand alone in the world, at the park posture; the first step only makes the engine know where everything is.
    fn alone() -> (PhysicsWorld, Robot, Articulation, Joints) {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/robots/aros.toml");
        let robot = Robot::load(&file).unwrap();
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, 0.0, -9.81);
        world.integration_parameters.dt = PERIOD_S;
        let mut arm = Articulation::build(&mut world, &robot).unwrap();
        let mut joints = Joints { position: [0.0; JOINTS], velocity: [0.0; JOINTS] };
        joints.position[..ARM_JOINTS].copy_from_slice(&robot.park);
        arm.place(&mut world, &joints);
        world.step();
        arm.place(&mut world, &joints);
        (world, robot, arm, joints)
    }

    /// Something held a joint back by 6 degrees, and gives way.
    #[test]
    fn a_joint_that_was_held_back_returns_within_its_speed() {
        for held in 0..ARM_JOINTS {
            let (mut world, robot, mut arm, mut joints) = alone();
            let mut setpoints = joints.position.map(MotionState::at_rest);
            setpoints[held].position += 0.1;
            arm.command(&mut world, &setpoints);
            let mut fastest = 0.0f64;
            for _ in 0..500 {
                arm.drive(&mut world);
                world.step();
                arm.read(&world, &mut joints);
                fastest = fastest.max(joints.velocity[held].abs());
            }
            let off = (joints.position[held] - setpoints[held].position).abs();
            assert!(fastest <= robot.limits()[held].velocity, "joint {held}: {fastest} rad/s");
            assert!(off < 1e-3, "joint {held}: {off} rad off after half a second");
        }
    }

    /// The engine's own forward dynamics tell whether the torques are right: one joint after the other, and all at once.
    #[test]
    fn a_step_gives_each_joint_the_acceleration_that_its_setpoint_has() {
        for moved in 0..=ARM_JOINTS {
            let (mut world, _, mut arm, mut joints) = alone();
            let wanted: [f64; JOINTS] = std::array::from_fn(|joint| match joint {
                _ if joint >= ARM_JOINTS || (moved < ARM_JOINTS && moved != joint) => 0.0,
                _ => 10.0 - 3.0 * joint as f64,
            });
            let setpoints = std::array::from_fn(|joint| MotionState {
                position: joints.position[joint] + wanted[joint] * PERIOD_S * PERIOD_S,
                velocity: wanted[joint] * PERIOD_S,
                acceleration: wanted[joint],
            });
            arm.command(&mut world, &setpoints);
            arm.drive(&mut world);
            world.step();
            arm.read(&world, &mut joints);
            for (joint, wanted) in wanted[..ARM_JOINTS].iter().enumerate() {
                let off = joints.velocity[joint] / PERIOD_S - wanted;
                assert!(off.abs() < 0.5, "joint {joint} of {moved}: {off} rad/s² off {wanted}");
            }
        }
    }
}
