use bytemuck::{Pod, Zeroable};

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
