use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde::Serialize;

/// Resamples of a bootstrap. Efron and Tibshirani ask for 1000 or more where percentiles of them are used.
const RESAMPLES: usize = 2000;

/// A statistic with its bootstrap percentile interval (Efron and Tibshirani 1993, chapter 13).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Estimate {
    /// The statistic.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
    /// From how many observations.
    pub of: usize,
}

impl Estimate {
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

    fn of<T: Copy>(values: &[T], statistic: impl Fn(&mut dyn Iterator<Item = T>) -> f64) -> Option<Self> {
        if values.is_empty() {
            return None;
        }
        let mut rng = Pcg64Mcg::seed_from_u64(0);
        let mut resample = || {
            let mut chosen = (0..values.len()).map(|_| values[rng.random_range(0..values.len())]);
            statistic(&mut chosen)
        };
        let mut found: Vec<f64> = (0..RESAMPLES).map(|_| resample()).collect();
        found.sort_by(f64::total_cmp);
        let at = |quantile: f64| found[((quantile * RESAMPLES as f64) as usize).min(RESAMPLES - 1)];
        let value = statistic(&mut values.iter().copied());
        Some(Self { value, low: at(0.025), high: at(0.975), of: values.len() })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    use crate::statistics::Z;

    #[test]
    fn bootstrap_interval_of_a_mean_is_near_the_normal_one() {
        let values: Vec<f64> = (0..400).map(|index| f64::from(index % 20)).collect();
        let mean = Estimate::mean(&values).unwrap();
        let reach = Z * 5.77 / 20.0;
        assert!((mean.value - 9.5).abs() < 1e-9);
        assert!((mean.high - 9.5 - reach).abs() < 0.1 && (9.5 - mean.low - reach).abs() < 0.1, "{mean:?}");
        assert_eq!(Estimate::mean(&[]), None);
    }

    #[test]
    fn ratio_pairs_what_belongs_together_and_refuses_to_divide_by_nothing() {
        let pairs: Vec<(f64, f64)> =
            (1..50).map(|index| (f64::from(index), 2.0 * f64::from(index))).collect();
        let ratio = Estimate::ratio(&pairs).unwrap();
        assert_eq!((ratio.value, ratio.low, ratio.high), (0.5, 0.5, 0.5));
        assert_eq!(Estimate::ratio(&[(1.0, -1.0)]), None);
    }
}
