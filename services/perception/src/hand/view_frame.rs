use bytemuck::{Pod, Zeroable};
use coact_stage_state::{Implausible, finite};
use nalgebra::Vector3;

/// What is kept of one frame of the tracker.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct ViewFrame {
    /// Cycle of capture.
    pub cycle: u64,
    /// Wrist, m.
    pub wrist: [f64; 3],
    /// Thumb tip, m.
    pub thumb: [f64; 3],
    /// Index tip, m.
    pub index: [f64; 3],
    /// Middle tip, m.
    pub middle: [f64; 3],
}

impl ViewFrame {
    /// Middle between thumb and index tip, m.
    pub fn centre(&self) -> Vector3<f64> {
        (Vector3::from(self.thumb) + Vector3::from(self.index)) * 0.5
    }

    /// Distance of thumb and index tip, m.
    pub fn aperture(&self) -> f64 {
        (Vector3::from(self.thumb) - Vector3::from(self.index)).norm()
    }

    /// Refuses what is no frame.
    pub fn check(&self) -> Result<(), Implausible> {
        [self.wrist, self.thumb, self.index, self.middle]
            .iter()
            .try_for_each(|point| finite("hand.recent", point))
    }
}
