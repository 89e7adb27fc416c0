use crate::noise::{Noise, Stream};
use coact_messages::{JOINTS, JointReading};
use rand_distr::{Distribution, StandardNormal};

/// Scatter of a joint encoder, rad.
const POSITION: f64 = 2e-5;
/// Scatter of a joint's velocity, rad/s.
const VELOCITY: f64 = 1e-3;

/// Reads all joint encoders and the fingertip force.
pub(crate) fn read_joints(
    tick: u64,
    noise: &Noise,
    (position, velocity): (&[f64; JOINTS], &[f64; JOINTS]),
    touch: f64,
    out: &mut JointReading,
) {
    let mut rng = noise.at(Stream::Encoders, tick);
    let mut deviate = || -> f64 { StandardNormal.sample(&mut rng) };
    out.position = std::array::from_fn(|joint| position[joint] + POSITION * deviate());
    out.velocity = std::array::from_fn(|joint| velocity[joint] + VELOCITY * deviate());
    out.touch = touch;
}
