/// A quantity over field position and time.
#[derive(Debug, Clone, Default)]
pub struct Surface {
    /// What each population stands for, in their order in the field.
    pub labels: Vec<String>,
    /// Sites of each population.
    pub sites: usize,
    /// Time of the first sample, ms.
    pub start_ms: f64,
    /// Time between two samples, ms.
    pub period_ms: f64,
    /// Sample after sample, all sites of each.
    pub values: Vec<f32>,
}

impl Surface {
    /// Sites of all populations.
    pub fn width(&self) -> usize {
        self.labels.len() * self.sites
    }

    /// All samples, one after the other.
    pub fn samples(&self) -> impl ExactSizeIterator<Item = &[f32]> + Clone {
        self.values.chunks_exact(self.width().max(1))
    }

    /// How long it lasts, ms.
    pub fn duration_ms(&self) -> f64 {
        self.samples().len() as f64 * self.period_ms
    }

    /// The sample at a time, or the nearest one.
    pub fn at(&self, ms: f64) -> &[f32] {
        let last = self.samples().len().saturating_sub(1);
        let index = ((ms - self.start_ms) / self.period_ms).round().max(0.0) as usize;
        let width = self.width();
        &self.values[index.min(last) * width..][..width]
    }

    /// The smallest and the largest value; 0 is between them.
    pub fn extremes(&self) -> [f32; 2] {
        self.values.iter().fold([0.0; 2], |[low, high], &value| [low.min(value), high.max(value)])
    }

    /// Populations (by index) in which some value is above `limit`.
    pub fn reaching(&self, limit: f32) -> Vec<usize> {
        let reaches = |&row: &usize| {
            self.samples().any(|sample| sample[row * self.sites..][..self.sites].iter().any(|u| *u > limit))
        };
        (0..self.labels.len()).filter(reaches).collect()
    }

    /// These populations only.
    pub fn only(&self, rows: &[usize]) -> Self {
        let row = |sample: &[f32], row: usize| sample[row * self.sites..][..self.sites].to_vec();
        Self {
            labels: rows.iter().map(|&row| self.labels[row].clone()).collect(),
            values: self
                .samples()
                .flat_map(|sample| rows.iter().flat_map(move |&index| row(sample, index)))
                .collect(),
            ..*self
        }
    }

    /// The time between these two only, ms.
    pub fn between(&self, from_ms: f64, to_ms: f64) -> Self {
        let index = |ms: f64| ((ms - self.start_ms) / self.period_ms).round().max(0.0) as usize;
        let last = self.samples().len();
        let (from, to) = (index(from_ms).min(last), index(to_ms).min(last));
        Self {
            labels: self.labels.clone(),
            start_ms: self.start_ms + from as f64 * self.period_ms,
            values: self.values[from * self.width()..to * self.width()].to_vec(),
            ..*self
        }
    }
}
