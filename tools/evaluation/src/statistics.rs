//! Intervals of 95 %.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde::Serialize;

/// Quantile 0.975 of the normal distribution.
const Z: f64 = 1.959_964;
/// Resamples of a bootstrap.
const RESAMPLES: usize = 2000;

/// A share with its Wilson score interval (Wilson 1927; Brown, Cai and DasGupta 2001, equation 4).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Share {
    /// How many.
    pub count: usize,
    /// Of how many.
    pub of: usize,
    /// The share; 0 of nothing.
    pub share: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval; of nothing, the interval is all from 0 to 1.
    pub high: f64,
}

impl Share {
    /// `count` of `of`.
    pub fn new(count: usize, of: usize) -> Self {
        if of == 0 {
            return Self { count, of, share: 0.0, low: 0.0, high: 1.0 };
        }
        let (n, share) = (of as f64, (count as f64 / of as f64).min(1.0));
        let scale = 1.0 + Z * Z / n;
        let centre = (share + Z * Z / (2.0 * n)) / scale;
        let reach = Z / scale * (share * (1.0 - share) / n + Z * Z / (4.0 * n * n)).sqrt();
        let (low, high) = ((centre - reach).max(0.0), (centre + reach).min(1.0));
        Self { count, of, share: count as f64 / n, low, high: high.max(share) }
    }
}

/// A figure with its bootstrap percentile interval (Efron and Tibshirani 1993, chapter 13), 2000 resamples.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Interval {
    /// The figure.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
    /// From how many observations.
    pub of: usize,
}

impl Interval {
    /// Mean of `values`; `None` without any.
    pub fn mean(values: &[f64]) -> Option<Self> {
        Self::of(values, |chosen| {
            let (sum, count) = chosen.fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
            sum / f64::from(count)
        })
    }

    /// Ratio of the means of pairs; `None` without pairs, and where the mean of the second ones is not above 0, because
    /// the ratio then says nothing.
    pub fn ratio(pairs: &[(f64, f64)]) -> Option<Self> {
        let ratio = |chosen: &mut dyn Iterator<Item = (f64, f64)>| {
            let (one, other) = chosen.fold((0.0, 0.0), |sums, pair| (sums.0 + pair.0, sums.1 + pair.1));
            if other > 0.0 { one / other } else { f64::NAN }
        };
        Self::of(pairs, ratio)
            .filter(|found| [found.value, found.low, found.high].iter().all(|x| x.is_finite()))
    }

    fn of<T: Copy>(values: &[T], figure: impl Fn(&mut dyn Iterator<Item = T>) -> f64) -> Option<Self> {
        if values.is_empty() {
            return None;
        }
        let mut rng = Pcg64Mcg::seed_from_u64(0);
        let mut resample = || {
            let mut chosen = (0..values.len()).map(|_| values[rng.random_range(0..values.len())]);
            figure(&mut chosen)
        };
        let mut found: Vec<f64> = (0..RESAMPLES).map(|_| resample()).collect();
        found.sort_by(f64::total_cmp);
        let at = |share: f64| found[((share * RESAMPLES as f64) as usize).min(RESAMPLES - 1)];
        let value = figure(&mut values.iter().copied());
        Some(Self { value, low: at(0.025), high: at(0.975), of: values.len() })
    }
}

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
        let rank = |share: f64| ((share * values.len() as f64).ceil() as usize).clamp(1, values.len()) - 1;
        let at = |share: f64| values[rank(share)];
        (!values.is_empty()).then(|| Self { p5: at(0.05), p50: at(0.5), p95: at(0.95) })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
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
            let share = Share::new(count, of);
            assert!((share.low - low).abs() < 1e-4 && (share.high - high).abs() < 1e-4, "{share:?}");
        }
        assert_eq!(Share::new(0, 0).high, 1.0);
        assert!(Share::new(5, 5).low < 1.0);
    }

    #[test]
    fn bootstrap_interval_of_a_mean_is_near_the_normal_one() {
        let values: Vec<f64> = (0..400).map(|index| f64::from(index % 20)).collect();
        let mean = Interval::mean(&values).unwrap();
        let reach = Z * 5.77 / 20.0;
        assert!((mean.value - 9.5).abs() < 1e-9);
        assert!((mean.high - 9.5 - reach).abs() < 0.1 && (9.5 - mean.low - reach).abs() < 0.1, "{mean:?}");
        assert_eq!(Interval::mean(&[]), None);
    }

    #[test]
    fn ratio_pairs_what_belongs_together_and_refuses_to_divide_by_nothing() {
        let pairs: Vec<(f64, f64)> =
            (1..50).map(|index| (f64::from(index), 2.0 * f64::from(index))).collect();
        let ratio = Interval::ratio(&pairs).unwrap();
        assert_eq!((ratio.value, ratio.low, ratio.high), (0.5, 0.5, 0.5));
        assert_eq!(Interval::ratio(&[(1.0, -1.0)]), None);
    }

    #[test]
    fn percentiles_are_observed_values() {
        let spread = Spread::new((1..=100).map(f64::from).collect()).unwrap();
        assert_eq!((spread.p5, spread.p50, spread.p95), (5.0, 50.0, 95.0));
        assert_eq!(Spread::new(Vec::new()), None);
    }
}
