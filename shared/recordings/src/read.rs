use crate::{Frame, ImagePoint, Reach, RecordingError, Size};
use csv::StringRecord;
use flate2::read::MultiGzDecoder;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Joints of the right arm and hand, as the columns name them, in the order of
/// `coact_messages::KeypointName`.
pub const JOINTS: [&str; 9] = [
    "RShoulder",
    "RElbow",
    "RWrist",
    "RPalmBase",
    "RThumb4FingerTip",
    "RIndex1Knuckles",
    "RIndex4FingerTip",
    "RMiddle4FingerTip",
    "RPinky1Knuckles",
];

/// How much text of one file is read at most, bytes: some thirty times the longest recording that is shipped, and little enough
/// that a compressed file cannot fill the memory.
const LARGEST: u64 = 64 << 20;
/// Longest reach that is plausible, s: ten times the longest recorded one.
const LONGEST: f64 = 10.0;

/// Reads every `.csv` and `.csv.gz` file of a folder, in the order of their names.
///
/// # Errors
/// [`RecordingError`] when the folder holds none, one of them is refused, or one stands there both ways.
pub fn read_folder(folder: &Path) -> Result<Vec<Reach>, RecordingError> {
    let io = |reason| RecordingError::Io { path: folder.to_path_buf(), reason };
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(io)? {
        let path = entry.map_err(io)?.path();
        if recording_name(&path).is_some() {
            files.push(path);
        }
    }
    files.sort();
    if let Some(pair) = files.windows(2).find(|pair| recording_name(&pair[0]) == recording_name(&pair[1])) {
        return Err(RecordingError::Twice { path: pair[1].clone(), other: pair[0].clone() });
    }
    if files.is_empty() {
        return Err(RecordingError::Empty { path: folder.to_path_buf() });
    }
    let mut reaches = Vec::new();
    for file in files {
        reaches.extend(read_file(&file)?);
    }
    Ok(reaches)
}

/// A file's name without the endings of a recording; none for other files.
fn recording_name(path: &Path) -> Option<&str> {
    let name = path.file_name()?.to_str()?;
    name.strip_suffix(".gz").unwrap_or(name).strip_suffix(".csv")
}

/// Reads one file; one that ends in `.gz` is decompressed on the way.
///
/// # Errors
/// [`RecordingError`] with file and line for a missing column, a field that is no number or out of range, a broken
/// line, frames out of order, or a reach that stands in two places.
pub fn read_file(path: &Path) -> Result<Vec<Reach>, RecordingError> {
    let text = read_text(path)?;
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_slice());
    let header = reader.headers().map_err(|error| broken(path, &error))?.clone();
    let columns = Columns::find(path, &header)?;
    let mut reaches: Vec<Reach> = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| broken(path, &error))?;
        let line = record.position().map_or(0, csv::Position::line);
        let row = columns.row(&record).map_err(|message| at(path, line, message))?;
        append(row, &mut reaches).map_err(|message| at(path, line, message))?;
    }
    Ok(reaches)
}

/// The whole text of a file, decompressed if need be.
pub(crate) fn read_text(path: &Path) -> Result<Vec<u8>, RecordingError> {
    let io = |reason| RecordingError::Io { path: path.to_path_buf(), reason };
    let file = coact_input_file::open(path).map_err(io)?;
    let is_compressed = path.extension().is_some_and(|extension| extension == "gz");
    let source: Box<dyn Read> =
        if is_compressed { Box::new(MultiGzDecoder::new(file)) } else { Box::new(file) };
    let mut text = Vec::new();
    source.take(LARGEST + 1).read_to_end(&mut text).map_err(io)?;
    if text.len() as u64 > LARGEST {
        return Err(RecordingError::TooLarge { path: path.to_path_buf(), limit: LARGEST });
    }
    Ok(text)
}

pub(crate) fn at(path: &Path, line: u64, message: String) -> RecordingError {
    RecordingError::Line { path: path.to_path_buf(), line, message }
}

pub(crate) fn broken(path: &Path, error: &csv::Error) -> RecordingError {
    let line = error.position().map_or(1, csv::Position::line);
    at(path, line, format!("{error}; expected as many comma-separated fields as the header has"))
}

/// One row: a frame and the reach that it belongs to, still without frames.
struct Row {
    reach: Reach,
    frame: Frame,
}

/// Adds the row's frame to its reach, which is the last one or a new one.
fn append(row: Row, reaches: &mut Vec<Reach>) -> Result<(), String> {
    let Row { reach, frame } = row;
    let same = |other: &Reach| {
        (other.participant, other.size, other.trial) == (reach.participant, reach.size, reach.trial)
    };
    let name = format!("participant {}, size {:?}, trial {}", reach.participant, reach.size, reach.trial);
    if !reaches.last().is_some_and(same) {
        if reaches.iter().any(same) {
            return Err(format!("{name} began and ended in earlier lines already"));
        }
        reaches.push(reach);
    } else if reaches.last().is_some_and(|last| last.movement_time != reach.movement_time) {
        return Err(format!(
            "mt_s of {name}: expected the same as in the line before, found {}",
            reach.movement_time
        ));
    }
    let frames = reaches.last_mut().map(|reach| &mut reach.frames);
    frames.map_or(Ok(()), |frames| add_frame(frame, frames))
}

fn add_frame(frame: Frame, frames: &mut Vec<Frame>) -> Result<(), String> {
    if let Some(last) = frames.last().filter(|last| frame.time <= last.time) {
        let (before, now) = (last.time, frame.time);
        return Err(format!(
            "t_rel_onset_s: expected more than {before}, as in the line before, found {now}"
        ));
    }
    frames.push(frame);
    Ok(())
}

/// Where each column stands.
struct Columns {
    participant: usize,
    size: usize,
    trial: usize,
    time: usize,
    movement_time: usize,
    /// x, y and p of each joint.
    joints: [[usize; 3]; 9],
}

impl Columns {
    fn find(path: &Path, header: &StringRecord) -> Result<Self, RecordingError> {
        let column = |name: &str, expected: &'static str| {
            header.iter().position(|own| own == name).ok_or_else(|| RecordingError::Column {
                path: PathBuf::from(path),
                column: name.to_owned(),
                expected,
            })
        };
        let mut joints = [[0; 3]; 9];
        for (slot, joint) in joints.iter_mut().zip(JOINTS) {
            *slot = [
                column(&format!("{joint}.x"), "pixels to the right")?,
                column(&format!("{joint}.y"), "pixels downwards")?,
                column(&format!("{joint}.p"), "confidence from 0 (lost) to about 1")?,
            ];
        }
        column("rtg", "1 within the reach, else 0")?;
        Ok(Self {
            participant: column("participant", "the person's number")?,
            size: column("size", "S, M or L")?,
            trial: column("trial", "the trial's number")?,
            time: column("t_rel_onset_s", "seconds since reach onset")?,
            movement_time: column("mt_s", "seconds from onset to the end of the grasp")?,
            joints,
        })
    }

    fn row(&self, record: &StringRecord) -> Result<Row, String> {
        let field = |column: usize| record.get(column).unwrap_or_default();
        let whole = |column: usize, name: &str| {
            let text = field(column);
            text.parse::<u32>().map_err(|_| format!("{name}: expected a whole number, found \"{text}\""))
        };
        let size = match field(self.size) {
            "S" => Size::Small,
            "M" => Size::Medium,
            "L" => Size::Large,
            other => return Err(format!("size: expected S, M or L, found \"{other}\"")),
        };
        let time = number(field(self.time), "t_rel_onset_s", -LONGEST, LONGEST)?;
        let movement_time = number(field(self.movement_time), "mt_s", 0.001, LONGEST)?;
        let mut joints = [ImagePoint::default(); 9];
        for ((point, columns), joint) in joints.iter_mut().zip(self.joints).zip(JOINTS) {
            *point = ImagePoint {
                x: number(field(columns[0]), &format!("{joint}.x"), -1e5, 1e5)?,
                y: number(field(columns[1]), &format!("{joint}.y"), -1e5, 1e5)?,
                confidence: number(field(columns[2]), &format!("{joint}.p"), 0.0, 1.1)?,
            };
        }
        let participant = whole(self.participant, "participant")?;
        let trial = whole(self.trial, "trial")?;
        let reach = Reach { participant, size, trial, movement_time, frames: Vec::new() };
        Ok(Row { reach, frame: Frame { time, joints } })
    }
}

pub(crate) fn number(text: &str, name: &str, low: f64, high: f64) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (low..=high).contains(&value) => Ok(value),
        _ => Err(format!("{name}: expected a number from {low} to {high}, found \"{text}\"")),
    }
}
