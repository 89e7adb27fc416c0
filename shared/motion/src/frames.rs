use crate::{Link, Mechanism};
use coact_robot::Posture;
use nalgebra::{Isometry3, SMatrix, Vector3};

/// Poses of all joint frames of an arm, and the axes about which they turn, in the world.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frames {
    pub pose: [Isometry3<f64>; 7],
    pub axis: [Vector3<f64>; 7],
}

impl Frames {
    pub fn of(mechanism: &Mechanism, posture: &Posture) -> Self {
        mechanism.heartbeat.beat();
        let mut frames = Self { pose: [Isometry3::identity(); 7], axis: [Vector3::zeros(); 7] };
        let mut pose = Isometry3::identity();
        for (index, (joint, &angle)) in mechanism.arm.joints.iter().zip(posture).enumerate() {
            pose *= joint.transform(angle);
            frames.pose[index] = pose;
            frames.axis[index] = pose.rotation * joint.axis.into_inner();
        }
        frames
    }

    /// Gradient, by the joints, of the position along `direction` of `point` (world, carried by the first `carriers`
    /// joints), m/rad.
    pub fn gradient(
        &self,
        point: &nalgebra::Point3<f64>,
        direction: &Vector3<f64>,
        carriers: usize,
    ) -> Posture {
        std::array::from_fn(|joint| {
            if joint >= carriers {
                return 0.0;
            }
            let arm = point.coords - self.pose[joint].translation.vector;
            self.axis[joint].cross(&arm).dot(direction)
        })
    }

    /// Jacobian, by the joints, of the position of `point` (world, carried by the first `carriers` joints), m/rad.
    pub fn jacobian(&self, point: &nalgebra::Point3<f64>, carriers: usize) -> SMatrix<f64, 3, 7> {
        let mut columns = SMatrix::<f64, 3, 7>::zeros();
        for joint in 0..carriers {
            let arm = point.coords - self.pose[joint].translation.vector;
            columns.set_column(joint, &self.axis[joint].cross(&arm));
        }
        columns
    }

    /// Pose of what carries a link, world.
    pub fn carrier(&self, link: &Link) -> Isometry3<f64> {
        link.carriers.checked_sub(1).map_or_else(Isometry3::identity, |joint| self.pose[joint])
    }
}
