/// How far a part between the fingers lets them close.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FingerStop {
    /// Base joint angle at which the fingers touch the part, rad; none when there is no part.
    pub base: Option<f64>,
    /// Tip angle for each rad of base angle.
    pub coupling: f64,
}

impl FingerStop {
    /// Largest angle of a joint (message order), rad.
    pub fn limit(&self, joint: usize) -> f64 {
        match (self.base, joint) {
            (Some(base), 8..=10) => base,
            (Some(base), 11..=13) => base * self.coupling,
            _ => f64::INFINITY,
        }
    }
}
