use super::Z;
use serde::Serialize;

/// A fraction of a count, with its Wilson score interval (Wilson 1927; Brown, Cai and DasGupta 2001, equation 4).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Proportion {
    /// How many.
    pub count: usize,
    /// Of how many.
    pub of: usize,
    /// The fraction; 0 of nothing.
    pub fraction: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval; of nothing, the interval is all from 0 to 1.
    pub high: f64,
}

impl Proportion {
    /// `count` of `of`.
    pub fn new(count: usize, of: usize) -> Self {
        if of == 0 {
            return Self { count, of, fraction: 0.0, low: 0.0, high: 1.0 };
        }
        let (n, fraction) = (of as f64, (count as f64 / of as f64).min(1.0));
        let scale = 1.0 + Z * Z / n;
        let centre = (fraction + Z * Z / (2.0 * n)) / scale;
        let reach = Z / scale * (fraction * (1.0 - fraction) / n + Z * Z / (4.0 * n * n)).sqrt();
        let (low, high) = ((centre - reach).max(0.0), (centre + reach).min(1.0));
        Self { count, of, fraction: count as f64 / n, low, high: high.max(fraction) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilson_interval_equals_the_published_one() {
        // Newcombe 1998, table I: 81 of 263, 15 of 148, 0 of 20, 1 of 29.
        for (count, of, low, high) in [
            (81, 263, 0.2553, 0.3662),
            (15, 148, 0.0624, 0.1605),
            (0, 20, 0.0, 0.1611),
            (1, 29, 0.0061, 0.1718),
        ] {
            let proportion = Proportion::new(count, of);
            assert!(
                (proportion.low - low).abs() < 1e-4 && (proportion.high - high).abs() < 1e-4,
                "{proportion:?}"
            );
        }
        assert_eq!(Proportion::new(0, 0).high, 1.0);
        assert!(Proportion::new(5, 5).low < 1.0);
    }
}
