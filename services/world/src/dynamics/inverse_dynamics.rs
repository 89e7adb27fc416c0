use rapier3d::math::DVector;
use rapier3d::prelude::*;

/// What a wanted motion of a multibody takes: the force and moment on each link, for its acceleration and against its weight,
/// world frame. What turning links exert on each other (Coriolis and centrifugal terms) is left to the feedback.
#[derive(Debug, Clone, Default)]
pub(super) struct InverseDynamics {
    /// Of the joints, rad/s².
    accelerations: DVector,
    /// Of each link, N and Nm.
    wrenches: Vec<(Vector, Vector)>,
}

impl InverseDynamics {
    /// Begins anew, with joints that all keep their velocities.
    pub fn clear(&mut self, body: &Multibody) {
        self.wrenches.clear();
        // Allocates once.
        self.accelerations.resize_vertically_mut(body.ndofs(), 0.0);
        self.accelerations.fill(0.0);
    }

    /// The joint that moves this link is to have this acceleration, rad/s².
    pub fn accelerate(&mut self, link: &MultibodyLink, acceleration: f64) {
        self.accelerations[link.assembly_id()] = acceleration;
    }

    /// Computes what all that takes.
    pub fn solve(&mut self, body: &Multibody, bodies: &RigidBodySet, gravity: Vector) {
        let Self { accelerations, wrenches } = self;
        let wrench = |(id, link): (usize, &MultibodyLink)| {
            let Some(rigid) = bodies.get(link.rigid_body_handle()) else {
                return (Vector::ZERO, Vector::ZERO);
            };
            let motion = body.body_jacobian(id) * &*accelerations;
            let linear = Vector::new(motion[0], motion[1], motion[2]);
            let angular = Vector::new(motion[3], motion[4], motion[5]);
            let inertia = rigid.mass_properties().effective_angular_inertia();
            (rigid.mass() * (linear - gravity), inertia * angular)
        };
        wrenches.extend(body.links().enumerate().map(wrench));
    }

    /// Torque of the joint that moves the link `joint`, Nm: that of all links about it, and its rotor's.
    pub fn torque(&self, body: &Multibody, joint: usize) -> f64 {
        let Some(column) = body.link(joint).map(|link| link.assembly_id()) else { return 0.0 };
        let about = |(id, (force, moment)): (usize, &(Vector, Vector))| {
            let way = body.body_jacobian(id).column(column);
            force.dot(Vector::new(way[0], way[1], way[2])) + moment.dot(Vector::new(way[3], way[4], way[5]))
        };
        let links: f64 = self.wrenches.iter().enumerate().map(about).sum();
        links + body.armature()[column] * self.accelerations[column]
    }
}
