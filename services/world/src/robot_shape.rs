use coact_messages::{ARM_JOINTS, JOINTS};
use coact_motion::{Capsule, Mechanism, MovingCapsules};
use coact_robot::{Robot, RobotError};

/// Where the robot's links are: what the camera above them sees of the table it sees past them.
pub(crate) struct RobotShape {
    mechanism: Mechanism,
    capsules: MovingCapsules,
    fingers: Vec<Capsule>,
    links: Vec<Capsule>,
}

impl RobotShape {
    /// # Errors
    /// [`RobotError`] when the collision geometry of a link cannot be used.
    pub fn new(robot: &Robot) -> Result<Self, RobotError> {
        let mechanism = Mechanism::of(robot)?;
        let capsules = MovingCapsules::of(&mechanism, &robot.hand)?;
        let [fingers, links] = std::array::from_fn(|_| Vec::with_capacity(capsules.most()));
        Ok(Self { mechanism, capsules, fingers, links })
    }

    /// Capsules around all links that move, for these joints in message order, rad.
    pub fn links(&mut self, joints: &[f64; JOINTS]) -> &[Capsule] {
        let Self { mechanism, capsules, fingers, links } = self;
        capsules.close(&std::array::from_fn(|joint| joints[ARM_JOINTS + joint]), fingers);
        capsules.place(mechanism, &std::array::from_fn(|joint| joints[joint]), fingers, links);
        links
    }
}
