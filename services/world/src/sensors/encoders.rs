use crate::dynamics::Joints;
use coact_messages::JointReading;
use coact_random::{RandomStreams, Stream};
use glam::DVec3;
use rand_distr::{Distribution, StandardNormal};

/// Scatter of a joint encoder, rad: about one count of an encoder of 18 bits on the joint.
const POSITION: f64 = 2e-5;
/// Scatter of a joint's velocity, rad/s: of the size of differences of such counts, filtered. Chosen by hand.
const VELOCITY: f64 = 1e-3;
/// Scatter of the fingertips' force, N. Chosen by hand, as is the next one: of the size of what tactile sensors in a gripper show at rest.
const TOUCH: f64 = 0.02;
/// Scatter of each component of the force on the wrist, N: of means of 30 ms.
const WRIST_FORCE: f64 = 0.03;

/// Reads all joint encoders, the fingertip force and the force on the wrist.
pub(crate) fn read_joints(
    tick: u64,
    random: &RandomStreams,
    joints: &Joints,
    (touch, wrist_force): (f64, DVec3),
    out: &mut JointReading,
) {
    let mut rng = random.at(Stream::Encoders, tick);
    let mut deviate = || -> f64 { StandardNormal.sample(&mut rng) };
    out.position = std::array::from_fn(|joint| joints.position[joint] + POSITION * deviate());
    out.velocity = std::array::from_fn(|joint| joints.velocity[joint] + VELOCITY * deviate());
    out.touch = touch + TOUCH * deviate();
    out.wrist_force = wrist_force.to_array().map(|force| force + WRIST_FORCE * deviate());
}
