use super::model::{CLASSES, DIRECTIONS, Level};
use nalgebra::{SMatrix, SVector};

pub(crate) const STACKED: usize = CLASSES * DIRECTIONS;
pub(crate) type Pair = SVector<f64, DIRECTIONS>;
pub(crate) type Square = SMatrix<f64, DIRECTIONS, DIRECTIONS>;
pub(crate) type Stack = SVector<f64, STACKED>;
pub(crate) type StackSquare = SMatrix<f64, STACKED, STACKED>;

/// The prior of one person's class means at one level: all classes stacked, correlated by the person's offset.
#[derive(Debug, Clone)]
pub(crate) struct Hierarchy {
    pub mean: Stack,
    pub covariance: StackSquare,
    pub precision: StackSquare,
    /// Covariance from reach to reach, and its inverse.
    pub within: Square,
    pub within_precision: Square,
}

/// How much of each class has been seen: responsibilities and responsibility-weighted sums.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Counts {
    pub weight: [f64; CLASSES],
    pub sum: [Pair; CLASSES],
}

impl Default for Counts {
    fn default() -> Self {
        Self { weight: [0.0; CLASSES], sum: [Pair::zeros(); CLASSES] }
    }
}

impl Counts {
    pub fn add(&mut self, responsibility: &[f64; CLASSES], at: &Pair) {
        for class in 0..CLASSES {
            self.weight[class] += responsibility[class];
            self.sum[class] += at * responsibility[class];
        }
    }
}

impl Hierarchy {
    /// `None` when a covariance is singular, which a checked model's is not.
    pub fn new(level: &Level) -> Option<Self> {
        let square = |rows: [[f64; DIRECTIONS]; DIRECTIONS]| Square::from_fn(|row, column| rows[row][column]);
        let (within, contrast, person) = (square(level.within), square(level.contrast), square(level.person));
        let covariance = StackSquare::from_fn(|row, column| {
            let (a, b) = (row % DIRECTIONS, column % DIRECTIONS);
            let same = if row / DIRECTIONS == column / DIRECTIONS { contrast[(a, b)] } else { 0.0 };
            person[(a, b)] + same
        });
        Some(Self {
            mean: Stack::from_fn(|row, _| level.mean[row / DIRECTIONS][row % DIRECTIONS]),
            covariance,
            precision: covariance.try_inverse()?,
            within,
            within_precision: within.try_inverse()?,
        })
    }

    /// Posterior mean and covariance of this person's class means.
    pub fn posterior(&self, counts: &Counts) -> (Stack, StackSquare) {
        let mut precision = self.precision;
        let mut pull = self.precision * self.mean;
        for class in 0..CLASSES {
            let at = class * DIRECTIONS;
            let mut block = precision.fixed_view_mut::<DIRECTIONS, DIRECTIONS>(at, at);
            block += self.within_precision * counts.weight[class];
            let mut part = pull.fixed_rows_mut::<DIRECTIONS>(at);
            part += self.within_precision * counts.sum[class];
        }
        match precision.try_inverse() {
            Some(covariance) => (covariance * pull, covariance),
            None => (self.mean, self.covariance),
        }
    }

    /// Logarithm of how well `at` fits each class with means `means`, up to a constant.
    pub fn fit(&self, at: &Pair, means: &Stack) -> [f64; CLASSES] {
        std::array::from_fn(|class| {
            let miss = at - means.fixed_rows::<DIRECTIONS>(class * DIRECTIONS);
            -0.5 * (miss.transpose() * self.within_precision * miss)[0]
        })
    }

    /// Logarithm of the prior density of `means`, up to a constant.
    pub fn prior(&self, means: &Stack) -> f64 {
        let miss = means - self.mean;
        -0.5 * (miss.transpose() * self.precision * miss)[0]
    }
}
