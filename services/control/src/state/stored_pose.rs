use bytemuck::{Pod, Zeroable};
use coact_stage_state::{Implausible, bounded};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

/// A frame as words: its origin (m) and its orientation (quaternion x, y, z, w).
#[repr(transparent)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub(crate) struct StoredPose(pub [f64; 7]);

/// A quaternion shorter than this has no direction; a stored one has length 1.
const SHORTEST: f64 = 1e-9;

/// No number of a pose is greater: the robot stands at a table, m.
const MOST: f64 = 10.0;

impl StoredPose {
    pub fn check(&self, field: &'static str) -> Result<(), Implausible> {
        bounded(field, &self.0, MOST)
    }

    pub fn isometry(&self) -> Isometry3<f64> {
        let [px, py, pz, x, y, z, w] = self.0;
        let rotation = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), SHORTEST).unwrap_or_default();
        Isometry3::from_parts(Translation3::new(px, py, pz), rotation)
    }
}

impl From<Isometry3<f64>> for StoredPose {
    fn from(pose: Isometry3<f64>) -> Self {
        let (at, turn) = (pose.translation.vector, pose.rotation.coords);
        Self([at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w])
    }
}
