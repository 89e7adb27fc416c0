use crate::ExtractionError;
use coact_recordings::ArmSide;
use serde::Deserialize;
use std::path::Path;

/// What the recorders say of a recording.
#[derive(Debug, Clone, Default, Deserialize)]
pub(crate) struct Keyframes {
    /// Frames at which a phase of the task ends and the next begins.
    #[serde(default, rename = "keyframes")]
    pub frames: Vec<usize>,
    /// The hand that puts down the first part of a stack.
    first_placing_hand: Option<Side>,
    /// The hand that gives or takes.
    object_holding_hand: Option<Side>,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Side {
    Left,
    Right,
}

impl Keyframes {
    /// Reads those beside a file of motion capture: of the same name, ending in `.json`.
    pub fn beside(recording: &Path) -> Result<Self, ExtractionError> {
        let path = recording.with_extension("json");
        let refused = |message: String| ExtractionError::Keyframes { path: path.clone(), message };
        let text = coact_input_file::read_text(&path).map_err(|error| refused(error.to_string()))?;
        let own: Self = serde_json::from_str(&text).map_err(|error| refused(error.to_string()))?;
        match own.frames.is_sorted_by(|one, next| one < next) {
            true => Ok(own),
            false => Err(refused(format!("keyframes: expected ascending frames, found {:?}", own.frames))),
        }
    }

    /// The hand that holds something first.
    pub fn hand(&self) -> Option<ArmSide> {
        self.first_placing_hand.or(self.object_holding_hand).map(|side| match side {
            Side::Left => ArmSide::Left,
            Side::Right => ArmSide::Right,
        })
    }
}
