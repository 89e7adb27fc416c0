use super::{FEATURES, ModelError};
use crate::reaching::MovementModel;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Size classes.
pub const CLASSES: usize = 3;
/// Phases of a reach at which features are kept: time since onset, in units of the person's tempo. Contact comes at
/// about 1.8.
pub const SNAPSHOTS: [f64; 6] = [0.65, 0.9, 1.1, 1.3, 1.5, 2.4];
/// The first so many of them are read while the reach goes on.
pub const READ: usize = 5;
/// The ones from which a reach that is over is judged as a whole: the last lies beyond the grasp.
pub const WHOLE: [usize; 3] = [2, 4, 5];
/// Features of a whole reach.
pub const WHOLE_LENGTH: usize = FEATURES * WHOLE.len();

/// What is known of people's reaches, from recordings of people: a small file of numbers, made by `coact train`.
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
    /// How their hands move.
    pub movement: MovementModel,
}

/// The discriminant at one phase, and the Gaussians of the hierarchy along it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Level {
    /// Direction in the space of features in which classes differ most, 1/m.
    pub direction: Vec<f64>,
    /// Mean of each class over all people.
    pub mean: [f64; CLASSES],
    /// Variance within a person's class: from reach to reach.
    pub within: f64,
    /// Variance of a person's deviation in one class.
    pub contrast: f64,
    /// Variance of a person's offset in all classes.
    pub person: f64,
}

impl PreshapeModel {
    /// Reads a model file.
    ///
    /// # Errors
    /// [`ModelError`] with the file and, for a malformed one, the line and what was expected.
    pub fn load(path: &Path) -> Result<Self, ModelError> {
        let text = coact_input_file::read_text(path)
            .map_err(|reason| ModelError::File { path: path.to_path_buf(), reason })?;
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
        self.movement.check().map_err(|message| format!("movement: {message}"))?;
        let all = self.phase.iter().map(|level| (level, FEATURES)).chain([(&self.whole, WHOLE_LENGTH)]);
        all.enumerate().try_for_each(|(index, (level, length))| {
            level.check(length).map_err(|message| format!("level {}: {message}", index + 1))
        })
    }
}

impl Level {
    fn check(&self, length: usize) -> Result<(), String> {
        if self.direction.len() != length {
            return Err(format!("direction: expected {length} numbers, found {}", self.direction.len()));
        }
        if !self.direction.iter().chain(&self.mean).all(|value| value.is_finite()) {
            return Err("direction and mean: expected finite numbers".into());
        }
        for (name, variance) in
            [("within", self.within), ("contrast", self.contrast), ("person", self.person)]
        {
            if !(variance > 0.0 && variance.is_finite()) {
                return Err(format!("{name}: expected a variance above 0, found {variance}"));
            }
        }
        Ok(())
    }

    /// Coordinate of `features` along the discriminant.
    pub(crate) fn project<'a>(&self, features: impl Iterator<Item = &'a f64>) -> f64 {
        self.direction.iter().zip(features).map(|(a, b)| a * b).sum()
    }
}
