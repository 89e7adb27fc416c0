use rapier3d::prelude::*;

/// The most that the person's fingers exert on a part, N. Chosen by hand: what 15 N of a precision grip carry by friction on both
/// sides, three times what people were measured to pull with in a handover (Khanna et al., RO-MAN 2023: 4.0 to 4.6 N).
const FORCE: f64 = 20.0;
/// The same as a torque, Nm: at half the breadth of the hand.
const TORQUE: f64 = FORCE * PersonGrip::HAND;
/// Natural frequency at which a free part follows the hand, critically damped, rad/s. Chosen by hand: within 0.1 mm on the way.
const STIFFNESS: f64 = 150.0;

/// The person's grip on a part: it goes where the hand goes, but with no more force than fingers have.
///
/// A part that followed the hand whatever it met went through the robot's fingers with up to 320 N, and threw the arm's joints beyond
/// their limits.
#[derive(Debug, Clone, Copy)]
pub(super) struct PersonGrip {
    part: usize,
    body: RigidBodyHandle,
    /// Where the hand has the part, or would have it.
    wanted: Pose,
    /// The same one step before.
    before: Pose,
}

impl PersonGrip {
    /// The person's hand is a ball of this radius, m: half the breadth of an adult's hand.
    pub const HAND: f64 = 0.045;

    /// On a part as it is now.
    pub fn new(world: &mut PhysicsWorld, part: usize, body: RigidBodyHandle) -> Self {
        let here = world.bodies.get_mut(body).map_or(Pose::IDENTITY, |body| {
            body.set_gravity_scale(0.0, true);
            *body.position()
        });
        Self { part, body, wanted: here, before: here }
    }

    /// The part that it was made for.
    pub fn part(&self) -> usize {
        self.part
    }

    /// The hand has the part there from now on.
    pub fn carry(&mut self, wanted: Pose) {
        self.wanted = wanted;
    }

    /// Pulls the part to where the hand has it, for the next step.
    pub fn pull(&mut self, world: &mut PhysicsWorld) {
        let seconds = world.integration_parameters.dt;
        let hand = (self.wanted.translation - self.before.translation) / seconds;
        self.before = self.wanted;
        let Some(body) = world.bodies.get_mut(self.body) else { return };
        let (behind, slower) = (self.wanted.translation - body.translation(), hand - body.linvel());
        let acceleration = STIFFNESS * STIFFNESS * behind + 2.0 * STIFFNESS * slower;
        let turned = (self.wanted.rotation * body.rotation().inverse()).to_scaled_axis();
        let turning = STIFFNESS * STIFFNESS * turned - 2.0 * STIFFNESS * body.angvel();
        let torque = body.mass_properties().effective_angular_inertia() * turning;
        let force = body.mass() * acceleration;
        body.reset_forces(true);
        body.reset_torques(true);
        body.add_force(force.clamp_length_max(FORCE), true);
        body.add_torque(torque.clamp_length_max(TORQUE), true);
    }

    /// The fingers open.
    pub fn open(self, world: &mut PhysicsWorld) {
        if let Some(body) = world.bodies.get_mut(self.body) {
            body.reset_forces(true);
            body.reset_torques(true);
            body.set_gravity_scale(1.0, true);
        }
    }
}
