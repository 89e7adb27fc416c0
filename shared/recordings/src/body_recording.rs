use crate::ArmSide;
use crate::RecordingError;
use crate::place_columns::{PlaceColumns, time_after, time_column};
use crate::read::{at, broken, read_text};
use csv::StringRecord;
use std::path::Path;

/// Where hands, shoulders and hip of a real person were, frame by frame, by motion capture.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyRecording {
    /// In the order of time.
    pub frames: Vec<BodyFrame>,
}

/// One frame, m: x to the right of the recorded person at the beginning, y ahead, z up. A body that was lost is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyFrame {
    /// Time of the recording, s.
    pub time: f64,
    /// Joints of the hands, in the order of [`ArmSide::BOTH`].
    pub hands: [Option<[f64; 3]>; 2],
    /// Shoulders, in the same order.
    pub shoulders: [Option<[f64; 3]>; 2],
    /// Middle of the hip.
    pub hip: Option<[f64; 3]>,
}

impl BodyRecording {
    /// Reads a file of motion capture.
    ///
    /// Columns: `t_s`, then `x_mm`, `y_mm`, `z_mm` of `left_hand`, `right_hand`, `left_shoulder`, `right_shoulder` and `hip`, as
    /// `left_hand.x_mm`; empty where a body was lost. Other columns are left out.
    ///
    /// # Errors
    /// [`RecordingError`] with file and line for a missing column, a field that is no number or out of range, and times
    /// that do not ascend.
    pub fn read(path: &Path) -> Result<Self, RecordingError> {
        let text = read_text(path)?;
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_slice());
        let columns = Columns::find(path, reader.headers().map_err(|error| broken(path, &error))?)?;
        let (mut frames, mut before) = (Vec::new(), f64::NEG_INFINITY);
        for record in reader.records() {
            let record = record.map_err(|error| broken(path, &error))?;
            let line = record.position().map_or(0, csv::Position::line);
            let frame = columns.frame(&record, before).map_err(|message| at(path, line, message))?;
            before = frame.time;
            frames.push(frame);
        }
        Ok(Self { frames })
    }
}

/// Where each column stands.
struct Columns {
    time: usize,
    hands: [PlaceColumns; 2],
    shoulders: [PlaceColumns; 2],
    hip: PlaceColumns,
}

impl Columns {
    fn find(path: &Path, header: &StringRecord) -> Result<Self, RecordingError> {
        let body = |name: &str| PlaceColumns::find(path, header, name);
        let [right, left] = ArmSide::BOTH.map(ArmSide::name);
        let both = |joint: &str| Ok([body(&format!("{right}_{joint}"))?, body(&format!("{left}_{joint}"))?]);
        Ok(Self {
            time: time_column(path, header)?,
            hands: both("hand")?,
            shoulders: both("shoulder")?,
            hip: body("hip")?,
        })
    }

    fn frame(&self, record: &StringRecord, before: f64) -> Result<BodyFrame, String> {
        let Self { time, hands, shoulders, hip } = self;
        let both = |columns: &[PlaceColumns; 2]| {
            Ok::<_, String>([columns[0].read(record)?, columns[1].read(record)?])
        };
        Ok(BodyFrame {
            time: time_after(before, record.get(*time).unwrap_or_default())?,
            hands: both(hands)?,
            shoulders: both(shoulders)?,
            hip: hip.read(record)?,
        })
    }
}
