use super::preshape_model::{CLASSES, Level};
use nalgebra::{Matrix3, Vector3};

/// The prior of one person's class means at one level: correlated by the person's offset.
#[derive(Debug, Clone)]
pub(crate) struct Hierarchy {
    pub mean: Vector3<f64>,
    covariance: Matrix3<f64>,
    precision: Matrix3<f64>,
    /// Variance from reach to reach.
    pub within: f64,
}

/// How much of each class has been seen: responsibilities, and responsibility-weighted sums.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Counts {
    weight: Vector3<f64>,
    sum: Vector3<f64>,
}

impl Counts {
    pub fn add(&mut self, responsibility: &[f64; CLASSES], at: f64) {
        let responsibility = Vector3::from(*responsibility);
        self.weight += responsibility;
        self.sum += responsibility * at;
    }

    /// How many reaches were of this class.
    pub fn weight(&self, class: usize) -> f64 {
        self.weight[class]
    }
}

impl Hierarchy {
    /// `None` when the covariance is singular, which a checked model's is not.
    pub fn new(level: &Level) -> Option<Self> {
        let covariance = Matrix3::from_element(level.person) + Matrix3::identity() * level.contrast;
        let precision = covariance.try_inverse()?;
        Some(Self { mean: level.mean.into(), covariance, precision, within: level.within })
    }

    /// Posterior mean and variance of each of this person's class means.
    pub fn posterior(&self, counts: &Counts) -> (Vector3<f64>, Vector3<f64>) {
        let precision = self.precision + Matrix3::from_diagonal(&(counts.weight / self.within));
        let pull = self.precision * self.mean + counts.sum / self.within;
        match precision.try_inverse() {
            Some(covariance) => (covariance * pull, covariance.diagonal()),
            None => (self.mean, self.covariance.diagonal()),
        }
    }

    /// Logarithm of how well `at` fits each class with means `means`, up to a constant.
    pub fn fit(&self, at: f64, means: &Vector3<f64>) -> [f64; CLASSES] {
        means.map(|mean| -0.5 * (at - mean).powi(2) / self.within).into()
    }

    /// Logarithm of the prior density of `means`, up to a constant.
    pub fn prior(&self, means: &Vector3<f64>) -> f64 {
        let miss = means - self.mean;
        -0.5 * miss.dot(&(self.precision * miss))
    }
}
