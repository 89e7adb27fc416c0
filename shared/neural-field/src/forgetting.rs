/// Dynamics of a resting level: how a memory is given up and becomes ready again (E. Bicho, P. Mallet, G. Schöner, Int. J.
/// Robotics Research 19, 2000).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forgetting {
    /// Resting level of a bistable field: peaks sustain themselves.
    pub h_max: f64,
    /// Resting level below the existence limit of a peak.
    pub h_min: f64,
    /// Rate towards `h_min` while a peak stands whose support is gone, per unit of time.
    pub r_min: f64,
    /// Rate back to `h_max` otherwise, per unit of time.
    pub r_max: f64,
}

/// One explicit Euler step of dh/dt = -r_min c (h - h_min) - r_max (1 - c) (h - h_max).
///
/// `c` in [0, 1] says how surely a peak stands and what supported it is gone.
pub fn forget(h: f64, c: f64, dt: f64, forgetting: &Forgetting) -> f64 {
    let Forgetting { h_max, h_min, r_min, r_max } = *forgetting;
    h - dt * (r_min * c * (h - h_min) + r_max * (1.0 - c) * (h - h_max))
}
