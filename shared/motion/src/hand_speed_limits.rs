/// How fast the hand may go, whatever its joints could do: what people beside the robot are comfortable with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HandSpeedLimits {
    /// On its way, m/s.
    pub free: f64,
    /// Where it begins to leave something, and comes to what it takes or puts into a place, m/s.
    pub contact: f64,
}

impl Default for HandSpeedLimits {
    /// 1 m/s and 0.25 m/s.
    fn default() -> Self {
        Self { free: 1.0, contact: 0.25 }
    }
}
