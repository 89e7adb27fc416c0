//! The ranges of all numbers in a task file.

use crate::TaskError;
use crate::source_file::SourceFile;
use std::ops::Range;
use toml::de::{DeTable, DeValue};

/// Range and unit of the numbers under each key. Wide: they hold every task on a table, and keep out what is no length, mass
/// or angle at all, or would make the computations behind it meaningless.
const RANGES: [(&str, f64, f64, &str); 26] = [
    ("kind.width", 1e-4, 1.0, "m"),
    ("kind.mass", 1e-5, 50.0, "kg"),
    ("kind.shape.cylinder.radius", 1e-4, 1.0, "m"),
    ("kind.shape.cylinder.height", 1e-4, 2.0, "m"),
    ("kind.shape.box.size", 1e-4, 2.0, "m"),
    ("part.at", -10.0, 10.0, "m"),
    ("subgoal.socket.at", -10.0, 10.0, "m"),
    ("subgoal.socket.axis", -1000.0, 1000.0, "of any length but 0"),
    ("grip.pitch", -180.0, 180.0, "degrees"),
    ("gesture.pitch", -180.0, 180.0, "degrees"),
    ("scene.table.height", -2.0, 5.0, "m"),
    ("scene.table.centre", -10.0, 10.0, "m"),
    ("scene.table.size", 0.01, 20.0, "m"),
    ("scene.platform.at", -10.0, 10.0, "m"),
    ("scene.platform.radius", 1e-3, 5.0, "m"),
    ("scene.platform.height", 1e-4, 5.0, "m"),
    ("scene.steady", -10.0, 10.0, "m"),
    ("scene.handover", -10.0, 10.0, "m"),
    ("scene.person_rest", -10.0, 10.0, "m"),
    ("scene.person_shoulder", -10.0, 10.0, "m"),
    ("scene.robot_workspace.min", -10.0, 10.0, "m"),
    ("scene.robot_workspace.max", -10.0, 10.0, "m"),
    ("scene.person_workspace.min", -10.0, 10.0, "m"),
    ("scene.person_workspace.max", -10.0, 10.0, "m"),
    ("scene.fit.position", 1e-5, 0.5, "m"),
    ("scene.fit.angle", 0.01, 180.0, "degrees"),
];

/// Refuses a number outside its range, and one that is not finite.
pub(super) fn check(source: &SourceFile) -> Result<(), TaskError> {
    // The text was parsed before: what is wrong with it as TOML is told there.
    let Ok(file) = DeTable::parse(source.text()) else { return Ok(()) };
    let place = Place { source, key: String::new(), path: String::new() };
    file.get_ref()
        .iter()
        .try_for_each(|(name, value)| place.under(name.get_ref()).value(value.get_ref(), value.span()))
}

/// A place in the file: its key as errors name it, with indices, and as [`RANGES`] does, without.
struct Place<'a> {
    source: &'a SourceFile,
    key: String,
    path: String,
}

impl Place<'_> {
    fn under(&self, name: &str) -> Self {
        let dot = if self.key.is_empty() { "" } else { "." };
        Place {
            source: self.source,
            key: format!("{}{dot}{name}", self.key),
            path: format!("{}{dot}{name}", self.path),
        }
    }

    fn at(&self, index: usize) -> Self {
        Place { source: self.source, key: format!("{}[{index}]", self.key), path: self.path.clone() }
    }

    fn value(&self, value: &DeValue<'_>, span: Range<usize>) -> Result<(), TaskError> {
        match value {
            DeValue::Table(table) => table.iter().try_for_each(|(name, value)| {
                self.under(name.get_ref()).value(value.get_ref(), value.span())
            }),
            DeValue::Array(entries) => (0..)
                .zip(entries.iter())
                .try_for_each(|(index, entry)| self.at(index).value(entry.get_ref(), entry.span())),
            DeValue::Float(number) => self.number(number.as_str().parse().unwrap_or(f64::NAN), span),
            DeValue::Integer(number) => {
                let whole = i64::from_str_radix(number.as_str(), number.radix());
                self.number(whole.map_or(f64::NAN, |whole| whole as f64), span)
            }
            _ => Ok(()),
        }
    }

    fn number(&self, number: f64, span: Range<usize>) -> Result<(), TaskError> {
        // A key that the table does not have is refused as unknown when the file is read.
        let Some((_, least, most, unit)) = RANGES.iter().find(|(path, ..)| *path == self.path) else {
            return Ok(());
        };
        if (*least..=*most).contains(&number) {
            return Ok(());
        }
        let problem = format!("{number}; expected {least} to {most} ({unit})");
        Err(self.source.error(span, self.key.clone(), problem))
    }
}
