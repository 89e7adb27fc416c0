use crate::Axis;

/// A symmetric kernel along one axis.
#[derive(Debug, Clone)]
pub(crate) struct Taps {
    pub centre: f64,
    /// At distances 1, 2, .. sites.
    pub beyond: Vec<f64>,
}

/// Standard deviations beyond which a Gaussian is cut off: there it is 4e-6 of its amplitude.
pub(crate) const CUT_OFF: f64 = 5.0;

impl Taps {
    /// Of a Gaussian along this axis, times the axis's spacing.
    pub fn gaussian(axis: &Axis, amplitude: f64, sigma: f64) -> Self {
        let weight = |site: usize| {
            let d = site as f64 * axis.spacing;
            amplitude * (-d * d / (2.0 * sigma * sigma)).exp() * axis.spacing
        };
        let reach = (CUT_OFF * sigma / axis.spacing).ceil() as usize;
        // Nothing lies farther away on an open axis; on a circle no site counts twice.
        let reach = reach.min(if axis.circular { (axis.sites - 1) / 2 } else { axis.sites - 1 });
        Self { centre: weight(0), beyond: (1..=reach).map(weight).collect() }
    }
}
