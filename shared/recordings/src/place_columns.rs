use crate::RecordingError;
use crate::read::number;
use csv::StringRecord;
use std::path::Path;

/// Nobody was recorded farther than this from the origin, mm.
const FARTHEST: f64 = 20_000.0;
/// Longest recording that is plausible, s: some hundred times the longest one that is known.
const LONGEST: f64 = 3600.0;

/// Where x, y and z of a body stand in a file of motion capture, and what they are called.
pub(crate) struct PlaceColumns([(usize, String); 3]);

impl PlaceColumns {
    /// Finds those of a body, as the columns name it: `left_hand`.
    pub fn find(path: &Path, header: &StringRecord, body: &str) -> Result<Self, RecordingError> {
        let place = |axis: &str| {
            let name = format!("{body}.{axis}_mm");
            Ok((column(path, header, &name, "mm, or nothing where the body was lost")?, name))
        };
        Ok(Self([place("x")?, place("y")?, place("z")?]))
    }

    /// Where the body was, m; none where it was lost.
    pub fn read(&self, record: &StringRecord) -> Result<Option<[f64; 3]>, String> {
        let (mut place, mut seen) = ([0.0; 3], true);
        for (value, (column, name)) in place.iter_mut().zip(&self.0) {
            match record.get(*column).unwrap_or_default() {
                "" => seen = false,
                text => *value = 1e-3 * number(text, name, -FARTHEST, FARTHEST)?,
            }
        }
        Ok(seen.then_some(place))
    }
}

/// Where the column of the time stands.
pub(crate) fn time_column(path: &Path, header: &StringRecord) -> Result<usize, RecordingError> {
    column(path, header, "t_s", "seconds since the recording began")
}

/// The time of a row, s; later than that of the row `before`.
pub(crate) fn time_after(before: f64, text: &str) -> Result<f64, String> {
    let time = number(text, "t_s", -LONGEST, LONGEST)?;
    if time <= before {
        return Err(format!("t_s: expected more than {before}, as in the line before, found {time}"));
    }
    Ok(time)
}

fn column(
    path: &Path,
    header: &StringRecord,
    name: &str,
    expected: &'static str,
) -> Result<usize, RecordingError> {
    header.iter().position(|own| own == name).ok_or_else(|| RecordingError::Column {
        path: path.to_path_buf(),
        column: name.to_owned(),
        expected,
    })
}
