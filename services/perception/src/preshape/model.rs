use super::{FEATURES, ModelError};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Size classes.
pub const CLASSES: usize = 3;
/// Discriminant directions: one less than classes.
pub const DIRECTIONS: usize = 2;
/// Phases of a reach at which features are kept: time since onset, in units of the person's tempo. Contact comes at
/// about 1.8.
pub const SNAPSHOTS: [f64; 6] = [0.65, 0.9, 1.1, 1.3, 1.5, 2.4];
/// The first so many of them are read while the reach goes on.
pub const READ: usize = 5;
/// The ones from which a reach that is over is judged as a whole: the last lies beyond the grasp.
pub const WHOLE: [usize; 3] = [2, 4, 5];
/// Features of a whole reach.
pub const WHOLE_LENGTH: usize = FEATURES * WHOLE.len();

/// What is known of people's preshaping, from recordings of people: a small file of numbers, made by `coact train`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PreshapeModel {
    /// Widths of the three size classes, m, ascending.
    pub sizes: [f64; CLASSES],
    /// Usual tempo over all people: time from onset to 80 % of the way to the slow phase, s.
    pub tempo: f64,
    /// One level for each phase that is read on the way, in the order of [`SNAPSHOTS`].
    pub phase: Vec<Level>,
    /// The level of whole reaches.
    pub whole: Level,
}

/// Discriminant directions at one phase, and the Gaussians of the hierarchy in them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Level {
    /// Directions in the space of features, 1/m.
    pub directions: [Vec<f64>; DIRECTIONS],
    /// Mean of each class over all people.
    pub mean: [[f64; DIRECTIONS]; CLASSES],
    /// Covariance within a person's class: from reach to reach.
    pub within: [[f64; DIRECTIONS]; DIRECTIONS],
    /// Covariance of a person's deviation in one class.
    pub contrast: [[f64; DIRECTIONS]; DIRECTIONS],
    /// Covariance of a person's offset in all classes.
    pub person: [[f64; DIRECTIONS]; DIRECTIONS],
}

impl PreshapeModel {
    /// Reads a model file.
    ///
    /// # Errors
    /// [`ModelError`] with the file and, for a malformed one, the line and what was expected.
    pub fn load(path: &Path) -> Result<Self, ModelError> {
        let text = std::fs::read_to_string(path)
            .map_err(|source| ModelError::File { path: path.to_path_buf(), source })?;
        Self::parse(&text).map_err(|(line, message)| ModelError::Malformed {
            path: path.to_path_buf(),
            line,
            message,
        })
    }

    /// Reads the text of a model file; an error is a line (from 1, or 0) and what was found and expected.
    ///
    /// # Errors
    /// Line (from 1; 0 where no line is to blame) and what was found and what was expected.
    pub fn parse(text: &str) -> Result<Self, (usize, String)> {
        let model: Self = toml::from_str(text).map_err(|error| {
            let line = error.span().map_or(0, |span| 1 + text[..span.start].matches('\n').count());
            (line, error.message().to_owned())
        })?;
        model.check().map_err(|message| (0, message))?;
        Ok(model)
    }

    fn check(&self) -> Result<(), String> {
        if !(self.sizes[0] > 0.0 && self.sizes.is_sorted_by(|a, b| a < b)) {
            return Err(format!("sizes: expected three ascending widths in m, found {:?}", self.sizes));
        }
        if !(self.tempo > 0.1 && self.tempo < 2.0) {
            return Err(format!("tempo: expected seconds between 0.1 and 2, found {}", self.tempo));
        }
        if self.phase.len() != READ {
            return Err(format!("phase: expected {READ} levels, found {}", self.phase.len()));
        }
        let all = self.phase.iter().map(|level| (level, FEATURES)).chain([(&self.whole, WHOLE_LENGTH)]);
        all.enumerate().try_for_each(|(index, (level, length))| {
            level.check(length).map_err(|message| format!("level {}: {message}", index + 1))
        })
    }
}

impl Level {
    fn check(&self, length: usize) -> Result<(), String> {
        if let Some(direction) = self.directions.iter().find(|direction| direction.len() != length) {
            return Err(format!("directions: expected {length} numbers each, found {}", direction.len()));
        }
        let finite =
            self.directions.iter().flatten().chain(self.mean.iter().flatten()).all(|v| v.is_finite());
        if !finite {
            return Err("directions and mean: expected finite numbers".into());
        }
        for (name, matrix) in [("within", self.within), ("contrast", self.contrast), ("person", self.person)]
        {
            let [[xx, xy], [yx, yy]] = matrix;
            if !(xx > 0.0 && yy > 0.0 && xx * yy - xy * yx > 0.0 && xy == yx) {
                return Err(format!("{name}: expected a positive definite 2 x 2 matrix, found {matrix:?}"));
            }
        }
        Ok(())
    }

    /// Coordinates of `features` in the discriminant directions.
    pub(crate) fn project<'a>(&self, features: impl Iterator<Item = &'a f64> + Clone) -> [f64; DIRECTIONS] {
        let along = |direction: &Vec<f64>| direction.iter().zip(features.clone()).map(|(a, b)| a * b).sum();
        [along(&self.directions[0]), along(&self.directions[1])]
    }
}
