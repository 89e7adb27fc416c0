use coact_messages::JOINTS;

/// Measured joint positions, rad, and velocities, rad/s, in message order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Joints {
    pub position: [f64; JOINTS],
    pub velocity: [f64; JOINTS],
}
