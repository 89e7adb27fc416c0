use coact_perception::{CLASSES, Level};
use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};

/// Fraction of the covariance from reach to reach that is moved onto its diagonal, so that it can be inverted.
///
/// Chosen by hand; small, for there are dozens of reaches of each person.
const WITHIN_SHRINKAGE: f64 = 0.1;
/// The same of the covariance of people's classes: larger, for there are few people. Chosen by hand.
const CONTRAST_SHRINKAGE: f64 = 0.3;
/// Fraction of the variance from reach to reach that every variance between people has at least.
///
/// Chosen by hand: few people who happen to agree do not mean that all do.
const LEAST_BETWEEN_PEOPLE: f64 = 0.02;
/// Significant digits of the numbers of a model: far finer than six people determine them, short enough to read.
const DIGITS: usize = 6;

/// Feature vectors of one person, by class.
pub(crate) type PersonFeatures = [Vec<DVector<f64>>; CLASSES];

/// The Gaussians of the hierarchy in the space of features.
struct Moments {
    /// Mean of each class over people, from the mean of all classes; and that mean.
    contrast: Vec<DVector<f64>>,
    centre: DVector<f64>,
    within: DMatrix<f64>,
    deviation: DMatrix<f64>,
    person: DMatrix<f64>,
}

/// The level of the model that these people's features make, in closed form. `None` when there are fewer than three
/// people, or a class that somebody never reached for, or features that do not vary.
pub(crate) fn level(people: &[PersonFeatures]) -> Option<Level> {
    let full = people.iter().all(|person| person.iter().all(|class| class.len() > 1));
    if people.len() < 3 || !full {
        return None;
    }
    let moments = moments(people);
    let direction = direction(&moments)?;
    let along = |matrix: &DMatrix<f64>| direction.dot(&(matrix * &direction));
    let within = along(&moments.within);
    let mean = |class: usize| direction.dot(&(&moments.contrast[class] + &moments.centre));
    Some(Level {
        direction: direction.iter().map(|value| rounded(*value)).collect(),
        mean: std::array::from_fn(|class| rounded(mean(class))),
        within: rounded(within),
        contrast: rounded(along(&moments.deviation) + LEAST_BETWEEN_PEOPLE * within),
        person: rounded(along(&moments.person) + LEAST_BETWEEN_PEOPLE * within),
    })
}

fn moments(people: &[PersonFeatures]) -> Moments {
    let length = people[0][0][0].len();
    let mean = |class: &Vec<DVector<f64>>| sum(length, class.iter()) / class.len() as f64;
    let means: Vec<[DVector<f64>; CLASSES]> =
        people.iter().map(|person| std::array::from_fn(|c| mean(&person[c]))).collect();
    let centres: Vec<DVector<f64>> =
        means.iter().map(|own| sum(length, own.iter()) / CLASSES as f64).collect();
    let count = people.len() as f64;
    let centre = sum(length, centres.iter()) / count;
    let contrast: Vec<DVector<f64>> = (0..CLASSES)
        .map(|class| {
            means
                .iter()
                .zip(&centres)
                .fold(DVector::zeros(length), |sum, (own, centre)| sum + &own[class] - centre)
                / count
        })
        .collect();
    let (mut within, mut deviation, mut person) =
        (DMatrix::zeros(length, length), DMatrix::zeros(length, length), DMatrix::zeros(length, length));
    let mut freedom = 0.0;
    for ((own, means), offset) in people.iter().zip(&means).zip(&centres) {
        for class in 0..CLASSES {
            own[class].iter().for_each(|features| add_square(&mut within, &(features - &means[class])));
            freedom += own[class].len() as f64 - 1.0;
            add_square(&mut deviation, &(&means[class] - offset - &contrast[class]));
        }
        add_square(&mut person, &(offset - &centre));
    }
    Moments {
        within: shrunk(within / freedom, WITHIN_SHRINKAGE),
        deviation: deviation / ((CLASSES - 1) as f64 * (count - 1.0)),
        person: person / (count - 1.0),
        contrast,
        centre,
    }
}

fn sum<'a>(length: usize, vectors: impl Iterator<Item = &'a DVector<f64>>) -> DVector<f64> {
    vectors.fold(DVector::zeros(length), |sum, vector| sum + vector)
}

fn add_square(matrix: &mut DMatrix<f64>, vector: &DVector<f64>) {
    *matrix += vector * vector.transpose();
}

fn shrunk(matrix: DMatrix<f64>, fraction: f64) -> DMatrix<f64> {
    let diagonal = DMatrix::from_diagonal(&matrix.diagonal());
    matrix * (1.0 - fraction) + diagonal * fraction
}

/// The direction in which classes differ most, compared with how reaches of one person and people's classes scatter
/// (Fisher's discriminant). The larger the class, the greater its coordinate.
fn direction(moments: &Moments) -> Option<DVector<f64>> {
    let scatter = &moments.within + shrunk(moments.deviation.clone(), CONTRAST_SHRINKAGE);
    let whiten = Cholesky::new(scatter)?.l().try_inverse()?;
    let mut between = DMatrix::zeros(whiten.nrows(), whiten.nrows());
    moments.contrast.iter().for_each(|contrast| add_square(&mut between, &(&whiten * contrast)));
    let eigen = SymmetricEigen::new(between);
    let direction = whiten.transpose() * eigen.eigenvectors.column(eigen.eigenvalues.imax());
    let span = &moments.contrast[CLASSES - 1] - &moments.contrast[0];
    Some(if direction.dot(&span) < 0.0 { -direction } else { direction })
}

/// The number with [`DIGITS`] significant digits, for a file that people can read.
pub(crate) fn rounded(value: f64) -> f64 {
    format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(value)
}
