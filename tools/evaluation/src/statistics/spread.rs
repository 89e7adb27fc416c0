use serde::Serialize;

/// Nearest-rank percentiles.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// 5 % of the values are not above it.
    pub p5: f64,
    /// Median.
    pub p50: f64,
    /// 95 % are not above it.
    pub p95: f64,
}

impl Spread {
    /// Of `values`; `None` without any.
    pub fn new(mut values: Vec<f64>) -> Option<Self> {
        values.sort_by(f64::total_cmp);
        let rank =
            |fraction: f64| ((fraction * values.len() as f64).ceil() as usize).clamp(1, values.len()) - 1;
        let at = |fraction: f64| values[rank(fraction)];
        (!values.is_empty()).then(|| Self { p5: at(0.05), p50: at(0.5), p95: at(0.95) })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn percentiles_are_observed_values() {
        let spread = Spread::new((1..=100).map(f64::from).collect()).unwrap();
        assert_eq!((spread.p5, spread.p50, spread.p95), (5.0, 50.0, 95.0));
        assert_eq!(Spread::new(Vec::new()), None);
    }
}
