//! What many trials say: proportions, means and ratios with intervals of 95 %, and percentiles.

mod estimate;
mod proportion;
mod spread;

pub use estimate::Estimate;
pub use proportion::Proportion;
pub use spread::Spread;

/// Quantile 0.975 of the normal distribution: the half width of an interval of 95 %, in standard deviations.
const Z: f64 = 1.959_964;
