use coact_perception::{CLASSES, DIRECTIONS, Level};
use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};

/// Share of a covariance that is moved onto its diagonal: from reach to reach, and of people's classes, of which there
/// are few.
const WITHIN_SHRINKAGE: f64 = 0.1;
const CONTRAST_SHRINKAGE: f64 = 0.3;
/// Share of the covariance from reach to reach that every covariance between people has at least.
const LEAST: f64 = 0.02;
/// Significant digits of the numbers of a model.
const DIGITS: usize = 6;

/// Feature vectors of one person, by class.
pub(crate) type Person = [Vec<DVector<f64>>; CLASSES];

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
pub(crate) fn level(people: &[Person]) -> Option<Level> {
    let full = people.iter().all(|person| person.iter().all(|class| class.len() > 1));
    if people.len() < 3 || !full {
        return None;
    }
    let moments = moments(people);
    let directions = directions(&moments)?;
    let project = |vector: &DVector<f64>| directions.transpose() * vector;
    let squeeze = |matrix: &DMatrix<f64>| directions.transpose() * matrix * &directions;
    let within = squeeze(&moments.within);
    let floor = DMatrix::from_diagonal(&(within.diagonal() * LEAST));
    Some(Level {
        directions: std::array::from_fn(|axis| directions.column(axis).iter().map(|v| rounded(*v)).collect()),
        mean: std::array::from_fn(|class| {
            let mean = project(&(&moments.contrast[class] + &moments.centre));
            std::array::from_fn(|axis| rounded(mean[axis]))
        }),
        contrast: square(&(squeeze(&moments.deviation) + &floor)),
        person: square(&(squeeze(&moments.person) + &floor)),
        within: square(&within),
    })
}

fn moments(people: &[Person]) -> Moments {
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

fn shrunk(matrix: DMatrix<f64>, share: f64) -> DMatrix<f64> {
    let diagonal = DMatrix::from_diagonal(&matrix.diagonal());
    matrix * (1.0 - share) + diagonal * share
}

/// Directions in which classes differ most, compared with how reaches of one person and people's classes scatter
/// (Fisher's discriminants). The larger the class, the greater its coordinate.
fn directions(moments: &Moments) -> Option<DMatrix<f64>> {
    let scatter = &moments.within + shrunk(moments.deviation.clone(), CONTRAST_SHRINKAGE);
    let root = Cholesky::new(scatter)?.l();
    let whiten = root.try_inverse()?;
    let mut between = DMatrix::zeros(whiten.nrows(), whiten.nrows());
    moments.contrast.iter().for_each(|contrast| add_square(&mut between, &(&whiten * contrast)));
    let eigen = SymmetricEigen::new(between);
    let mut ranks: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    ranks.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    let span = &moments.contrast[CLASSES - 1] - &moments.contrast[0];
    let columns: Vec<DVector<f64>> = ranks[..DIRECTIONS]
        .iter()
        .map(|rank| {
            let direction = whiten.transpose() * eigen.eigenvectors.column(*rank);
            if direction.dot(&span) < 0.0 { -direction } else { direction }
        })
        .collect();
    Some(DMatrix::from_columns(&columns))
}

fn square(matrix: &DMatrix<f64>) -> [[f64; DIRECTIONS]; DIRECTIONS] {
    let symmetric =
        |row: usize, column: usize| rounded(0.5 * (matrix[(row, column)] + matrix[(column, row)]));
    std::array::from_fn(|row| std::array::from_fn(|column| symmetric(row, column)))
}

/// The number with [`DIGITS`] significant digits, for a file that people can read.
pub(crate) fn rounded(value: f64) -> f64 {
    format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(value)
}
