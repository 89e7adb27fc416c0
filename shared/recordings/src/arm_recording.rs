use crate::place_columns::{PlaceColumns, time_after, time_column};
use crate::read::{at, broken, read_text};
use crate::{ArmSide, RecordingError};
use csv::StringRecord;
use std::path::{Path, PathBuf};

/// How the arm of a real person moved, by motion capture: what was recorded of it without a break, stretch by stretch.
///
/// A stretch ends where a body was lost for longer than is bridged, and where its markers were mistaken for others: what
/// the recorders did not see is not made up.
#[derive(Debug, Clone, PartialEq)]
pub struct ArmRecording {
    /// At least one, in the order of time; each has at least two samples and lasts [`ArmRecording::SHORTEST`] or more.
    pub stretches: Vec<Vec<ArmSample>>,
    /// From the first sample of the file to its last, s.
    pub duration: f64,
}

/// Where shoulder, elbow and wrist were at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmSample {
    /// Time of the recording, s.
    pub time: f64,
    /// Shoulder, elbow, wrist, m: x to the right of the recorded person, y ahead, z up.
    pub joints: Joints,
}

/// Shoulder, elbow, wrist, m.
type Joints = [[f64; 3]; 3];

/// The bodies that an arm is made of, as the columns name them after `left_` or `right_`. What is called hand is its
/// joint: it was 0.25 m from the elbow (median of 40 arms), as wrists are (0.26 m at 1.70 m of stature, Winter 2009).
const BODIES: [&str; 3] = ["shoulder", "elbow", "hand"];
/// Longest loss of a body that is bridged, s: five frames, in which 25 m/s² move it by 8 mm from where it is thought to be.
const BRIDGED: f64 = 0.055;
/// Acceleration that no joint of an arm had, m/s²: of the recorded hands, 25 m/s² hold 99.9 %. What exceeds this jumps from
/// sample to sample: markers were mistaken for others. 1 sample in 100 does, most of them shoulders and elbows.
const FASTEST: f64 = 100.0;

impl ArmRecording {
    /// Shortest stretch that is used, s: a movement of an arm takes about as long, with what leads to it.
    pub const SHORTEST: f64 = 2.0;

    /// Reads one arm of a file of motion capture.
    ///
    /// Columns: `t_s`, then `x_mm`, `y_mm`, `z_mm` of `left_shoulder`, `left_elbow`, `left_hand` and of the right ones, as
    /// `left_hand.x_mm`; empty where a body was lost. Other columns are left out.
    ///
    /// # Errors
    /// [`RecordingError`] with file and line for a missing column, a field that is no number or out of range, and times
    /// that do not ascend; without a line when the arm was nowhere seen for long enough.
    pub fn read(path: &Path, side: ArmSide) -> Result<Self, RecordingError> {
        let text = read_text(path)?;
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_slice());
        let columns = Columns::find(path, side, reader.headers().map_err(|error| broken(path, &error))?)?;
        let (mut samples, mut times) = (Vec::new(), (f64::INFINITY, f64::NEG_INFINITY));
        for record in reader.records() {
            let record = record.map_err(|error| broken(path, &error))?;
            let line = record.position().map_or(0, csv::Position::line);
            let (time, joints) = columns.row(&record, times.1).map_err(|message| at(path, line, message))?;
            times = (times.0.min(time), time);
            samples.extend(joints.map(|joints| ArmSample { time, joints }));
        }
        let stretches = stretches(&samples);
        if stretches.is_empty() {
            return Err(RecordingError::Unseen { path: PathBuf::from(path), side, shortest: Self::SHORTEST });
        }
        Ok(Self { stretches, duration: times.1 - times.0 })
    }

    /// How long the arm was recorded without a break, all stretches together, s.
    pub fn seen(&self) -> f64 {
        self.stretches.iter().map(|stretch| stretch[stretch.len() - 1].time - stretch[0].time).sum()
    }
}

/// What is long enough of that in which no body was lost for long, and none jumped.
fn stretches(samples: &[ArmSample]) -> Vec<Vec<ArmSample>> {
    let jumps = |index: usize| {
        let around = index.checked_sub(1).and_then(|before| samples.get(before..=index + 1));
        around.is_some_and(|around| acceleration(around) > FASTEST)
    };
    let mut stretches = vec![Vec::new()];
    for (index, sample) in samples.iter().enumerate() {
        let last = stretches.last().and_then(|stretch: &Vec<ArmSample>| stretch.last());
        let is_lost = last.is_some_and(|last| sample.time - last.time > BRIDGED);
        if is_lost || jumps(index) {
            stretches.push(Vec::new());
        }
        if let Some(stretch) = stretches.last_mut().filter(|_| !jumps(index)) {
            stretch.push(*sample);
        }
    }
    stretches.retain(|stretch| match (stretch.first(), stretch.last()) {
        (Some(first), Some(last)) => last.time - first.time >= ArmRecording::SHORTEST,
        _ => false,
    });
    stretches
}

/// Greatest acceleration of a joint over three samples, m/s².
fn acceleration(samples: &[ArmSample]) -> f64 {
    let [before, now, after] = samples else { return 0.0 };
    let (one, other) = (now.time - before.time, after.time - now.time);
    let of = |joint: usize| {
        let along = |axis: usize| {
            let [before, now, after] = [before, now, after].map(|sample| sample.joints[joint][axis]);
            2.0 * ((after - now) / other - (now - before) / one) / (one + other)
        };
        (0..3).map(|axis| along(axis).powi(2)).sum::<f64>().sqrt()
    };
    (0..BODIES.len()).map(of).fold(0.0, f64::max)
}

/// Where each column stands.
struct Columns {
    time: usize,
    bodies: [PlaceColumns; 3],
}

impl Columns {
    fn find(path: &Path, side: ArmSide, header: &StringRecord) -> Result<Self, RecordingError> {
        let body = |body: &str| PlaceColumns::find(path, header, &format!("{}_{body}", side.name()));
        let [shoulder, elbow, hand] = BODIES;
        Ok(Self { time: time_column(path, header)?, bodies: [body(shoulder)?, body(elbow)?, body(hand)?] })
    }

    /// Time, later than that of the row `before`, and the joints where none of them was lost.
    fn row(&self, record: &StringRecord, before: f64) -> Result<(f64, Option<Joints>), String> {
        let time = time_after(before, record.get(self.time).unwrap_or_default())?;
        let mut joints = [[0.0; 3]; 3];
        let mut seen = true;
        for (joint, columns) in joints.iter_mut().zip(&self.bodies) {
            match columns.read(record)? {
                Some(place) => *joint = place,
                None => seen = false,
            }
        }
        Ok((time, seen.then_some(joints)))
    }
}
