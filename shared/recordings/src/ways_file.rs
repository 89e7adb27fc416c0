use crate::read::{at, broken, number, read_text};
use crate::{ArmSide, RecordingError, Way, WayKind};
use csv::StringRecord;
use std::path::Path;

/// The columns before those of the points.
const LEADING: [&str; 7] =
    ["kind", "recording", "hand", "first_frame", "last_frame", "distance_m", "duration_s"];
/// Directions of a point, as its columns are called after `along.0`.
const AXES: [&str; 3] = ["along", "aside", "up"];
/// A hand reaches no farther than this without a step, m.
const FARTHEST: f64 = 2.0;
/// Longest way that is plausible, s.
const LONGEST: f64 = 10.0;
/// Farthest that a point is from the beginning, in units of the distance: what goes farther is no way to the end.
const ASTRAY: f64 = 2.0;

/// Reads the ways of hands that carry, give and withdraw: a CSV file, one way in each line, as
/// [`ways_text`] writes it.
///
/// # Errors
/// [`RecordingError`] with file and line for a missing column, a field that is not what it can be, a way that does not
/// begin at 0, 0, 0 or not end at 1, 0, 0; without a line when there is no way at all.
pub fn read_ways(path: &Path) -> Result<Vec<Way>, RecordingError> {
    let text = read_text(path)?;
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_slice());
    check_header(path, reader.headers().map_err(|error| broken(path, &error))?)?;
    let mut ways = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| broken(path, &error))?;
        let line = record.position().map_or(0, csv::Position::line);
        ways.push(way(&record).map_err(|message| at(path, line, message))?);
    }
    if ways.is_empty() {
        return Err(at(path, 2, "expected a way in each line, found none".to_owned()));
    }
    Ok(ways)
}

/// The file that holds these ways.
pub fn ways_text(ways: &[Way]) -> String {
    let mut text = columns().collect::<Vec<_>>().join(",") + "\n";
    for way in ways {
        let Way { kind, recording, hand, frames: [first, last], distance, duration, points } = way;
        let (kind, hand) = (kind.name(), hand.name());
        text += &format!("{kind},{recording},{hand},{first},{last},{distance:.4},{duration:.2}");
        points.as_flattened().iter().for_each(|value| text += &format!(",{value:.4}"));
        text += "\n";
    }
    text
}

fn columns() -> impl Iterator<Item = String> {
    let points = (0..Way::POINTS).flat_map(|point| AXES.map(|axis| format!("{axis}.{point}")));
    LEADING.map(str::to_owned).into_iter().chain(points)
}

/// The order of the columns is fixed: who reads a hundred of them by eye is helped by it.
fn check_header(path: &Path, header: &StringRecord) -> Result<(), RecordingError> {
    for (index, column) in columns().enumerate() {
        if header.get(index) != Some(column.as_str()) {
            let expected = "kind, recording, hand, first_frame, last_frame, distance_m, duration_s, then along, aside \
                            and up of each of 33 points, in this order";
            return Err(RecordingError::Column { path: path.to_path_buf(), column, expected });
        }
    }
    Ok(())
}

fn way(record: &StringRecord) -> Result<Way, String> {
    let field = |column: usize| record.get(column).unwrap_or_default();
    let frame = |column: usize| {
        let text = field(column);
        text.parse::<u32>()
            .map_err(|_| format!("{}: expected a whole number, found \"{text}\"", LEADING[column]))
    };
    let kind = WayKind::ALL.into_iter().find(|kind| kind.name() == field(0));
    let hand = ArmSide::BOTH.into_iter().find(|side| side.name() == field(2));
    let mut points = [[0.0; 3]; Way::POINTS];
    for (index, value) in points.as_flattened_mut().iter_mut().enumerate() {
        let name = || format!("{}.{}", AXES[index % AXES.len()], index / AXES.len());
        *value = number(field(LEADING.len() + index), &name(), -ASTRAY, ASTRAY)?;
    }
    check_ends(&points)?;
    let frames = [frame(3)?, frame(4)?];
    if frames[1] <= frames[0] {
        return Err(format!("last_frame: expected more than {}, found {}", frames[0], frames[1]));
    }
    Ok(Way {
        kind: kind
            .ok_or_else(|| format!("kind: expected carry, give or withdraw, found \"{}\"", field(0)))?,
        recording: field(1).to_owned(),
        hand: hand.ok_or_else(|| format!("hand: expected left or right, found \"{}\"", field(2)))?,
        frames,
        distance: number(field(5), LEADING[5], 0.01, FARTHEST)?,
        duration: number(field(6), LEADING[6], 0.1, LONGEST)?,
        points,
    })
}

/// A hand that is put where the part is wanted must end exactly there.
fn check_ends(points: &[[f64; 3]; Way::POINTS]) -> Result<(), String> {
    let last = Way::POINTS - 1;
    for (point, expected) in [(0, Way::BEGINNING), (last, Way::END)] {
        if points[point] != expected {
            let ([along, aside, up], found) = (expected, points[point]);
            return Err(format!("point {point}: expected {along}, {aside}, {up}, found {found:?}"));
        }
    }
    Ok(())
}
