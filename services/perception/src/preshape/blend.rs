use super::preshape_model::CLASSES;

/// A value between two neighbouring entries of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Blend {
    pub low: usize,
    pub high: usize,
    /// Fraction of `high`.
    pub fraction: f64,
}

impl Blend {
    /// Where `value` lies in the ascending `row`; beyond its ends, the end itself.
    pub fn of(value: f64, row: &[f64]) -> Self {
        let last = row.len() - 1;
        let high = row.iter().position(|entry| *entry >= value).unwrap_or(last);
        let low = high.saturating_sub(1);
        let span = row[high] - row[low];
        let fraction = if span > 0.0 { ((value - row[low]) / span).clamp(0.0, 1.0) } else { 0.0 };
        Self { low, high, fraction }
    }

    /// The value between `low` and `high`.
    pub fn mix(&self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.fraction
    }

    /// Marks the nearer of the two classes.
    pub fn mark(&self, possible: &mut [bool; CLASSES]) {
        possible[if self.fraction < 0.5 { self.low } else { self.high }] = true;
    }
}
