use crate::Joint;
use nalgebra::{Isometry3, Point3};

/// A serial arm from the world frame to the palm frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Arm {
    /// Its joints, from the base outwards; the first one's origin includes the base's place in the world.
    pub joints: Vec<Joint>,
    /// Pose of the palm frame in the last joint's frame.
    pub tool: Isometry3<f64>,
}

impl Arm {
    /// Pose of the palm in the world. `posture`: at least one angle for each joint, rad; more are ignored.
    ///
    /// Palm frame: origin in the palm, z out of the palm (the approach axis), x the direction in which the fingers
    /// close (from finger 3 towards fingers 1 and 2).
    pub fn palm(&self, posture: &[f64]) -> Isometry3<f64> {
        let chain = self.joints.iter().zip(posture);
        chain.fold(Isometry3::identity(), |pose, (joint, &angle)| pose * joint.transform(angle)) * self.tool
    }

    /// Pose of the frame of joint `index` (0-based), after its rotation, in the world.
    pub fn frame(&self, posture: &[f64], index: usize) -> Isometry3<f64> {
        let chain = self.joints.iter().zip(posture).take(index + 1);
        chain.fold(Isometry3::identity(), |pose, (joint, &angle)| pose * joint.transform(angle))
    }

    /// Centres of shoulder, elbow and wrist (joints 2, 4 and 6), m, world.
    pub fn centres(&self, posture: &[f64]) -> [Point3<f64>; 3] {
        [1, 3, 5].map(|index| Point3::from(self.frame(posture, index).translation.vector))
    }

    /// Whether every angle lies within its limits, shrunk by `margin` rad.
    pub fn within_limits(&self, posture: &[f64], margin: f64) -> bool {
        self.joints.iter().zip(posture).all(|(joint, &angle)| joint.limits.contain(angle, margin))
    }
}
