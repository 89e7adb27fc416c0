use crate::hand_course::HandCourse;
use crate::hand_phase::HandPhase;
use crate::keyframes::Keyframes;
use crate::movements::{movements, peak};
use crate::shape::Shape;
use crate::{ExtractionError, LeftOut, RecordedTask};
use coact_recordings::{BodyRecording, Way, WayKind, arm_files};
use std::path::Path;

/// The ways of all recordings, and what was left out.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Extraction {
    /// In the order of files and time, kind after kind.
    pub ways: Vec<Way>,
    /// Why other movements of the same phases are none of them, one by one.
    pub left_out: Vec<LeftOut>,
    /// How many recordings were looked at.
    pub recordings: usize,
}

/// Looks for ways in all recordings of a folder.
///
/// # Errors
/// [`ExtractionError`] when the folder or a file is refused, or no way of one of the kinds is in them.
pub fn extract(folder: &Path) -> Result<Extraction, ExtractionError> {
    let mut all = Extraction::default();
    for file in arm_files(folder)? {
        let Some(task) = RecordedTask::of(&file) else { continue };
        let recording = BodyRecording::read(&file)?;
        let keyframes = Keyframes::beside(&file)?;
        let phases = task.phases(&keyframes, recording.frames.len());
        let phases = phases
            .map_err(|message| ExtractionError::Keyframes { path: file.with_extension("json"), message })?;
        all.recordings += 1;
        for phase in phases {
            all.look_at(&recording, &phase, &name(&file));
        }
    }
    for (kind, does) in
        [(WayKind::Carry, "carries"), (WayKind::Give, "gives"), (WayKind::Withdraw, "withdraws")]
    {
        if !all.ways.iter().any(|way| way.kind == kind) {
            return Err(ExtractionError::Nothing { folder: folder.to_owned(), kind: does });
        }
    }
    all.ways.sort_by_key(|way| way.kind);
    Ok(all)
}

/// Folder and name of a recording, without its ending.
fn name(file: &Path) -> String {
    let parts = [file.parent().and_then(Path::file_name), file.file_stem()];
    parts.into_iter().flatten().map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/")
}

impl Extraction {
    /// Adds the ways of a hand in a phase.
    fn look_at(&mut self, recording: &BodyRecording, phase: &HandPhase, name: &str) {
        let course = HandCourse::of(recording, phase.hand);
        let speeds = course.speeds();
        let mut own = movements(&speeds);
        own.retain(|movement| phase.frames.contains(&peak(movement, &speeds)));
        for movement in own {
            let (first, last) = (movement.start, movement.end - 1);
            let is_cut = first.checked_sub(1).is_none_or(|before| speeds[before].is_none())
                || speeds.get(movement.end).copied().flatten().is_none();
            let fastest = speeds[peak(&movement, &speeds)].unwrap_or(0.0);
            let shape = if is_cut { Err(LeftOut::Lost) } else { Shape::of(&course, [first, last], fastest) };
            match shape {
                Err(reason) => self.left_out.push(reason),
                Ok(Shape { distance, duration, points }) => self.ways.push(Way {
                    kind: phase.kind,
                    recording: name.to_owned(),
                    hand: phase.hand,
                    frames: [first as u32, last as u32],
                    distance,
                    duration,
                    points,
                }),
            }
        }
    }
}
