/// Interaction of lateral-inhibition type: a Gaussian minus a constant (chapter, eq. 2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kernel {
    /// Amplitude A of the Gaussian.
    pub amplitude: f64,
    /// Standard deviation of the Gaussian, in the field's own unit of length.
    pub sigma: f64,
    /// Constant inhibition w_inhib, per unit of length.
    pub inhibition: f64,
    /// How far the inhibition reaches; `None` = everywhere, so that all populations compete.
    ///
    /// With a range, populations do not interact at all, so that any of them may hold a peak beside any others (chapter, section 4: layers
    /// that memorise). If they did, the peaks of two neighbours would push each other away, and a population between two peaks that
    /// have come nearer so would never ignite.
    pub range: Option<f64>,
}

impl Kernel {
    /// w(d) for a distance `d`, without the excitation's cut-off at five sigma.
    pub fn weight(&self, d: f64) -> f64 {
        let inhibition = if self.range.is_none_or(|range| d.abs() <= range) { self.inhibition } else { 0.0 };
        self.amplitude * (-d * d / (2.0 * self.sigma * self.sigma)).exp() - inhibition
    }
}
