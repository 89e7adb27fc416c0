use serde::Deserialize;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

/// How much is recorded of what is large: `rt-config/recorder.toml`. All are cycles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecorderSettings {
    /// From one recorded field frame to the next.
    pub frames_every: u64,
    /// From one recorded command to the next.
    pub commands_every: u64,
    /// From one recorded truth to the next.
    pub truth_every: u64,
    /// From one recorded scene to the next.
    pub scene_every: u64,
}

/// Why there are none.
#[derive(Debug, thiserror::Error)]
pub enum SettingsError {
    /// The file cannot be read.
    #[error("{path}: {cause}; expected the settings of the recorder")]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        cause: std::io::Error,
    },
    /// It is not what `rt-config/recorder.toml` shows.
    #[error("{path}: {problem}; expected what rt-config/recorder.toml shows")]
    Malformed {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
}

impl RecorderSettings {
    /// Name of the file, beside the process table.
    pub const FILE: &str = "recorder.toml";

    /// Reads the file.
    ///
    /// # Errors
    /// [`SettingsError`] says what is wrong with it.
    pub fn load(path: &Path) -> Result<Self, SettingsError> {
        let text = coact_input_file::read_text(path)
            .map_err(|cause| SettingsError::File { path: path.to_owned(), cause })?;
        let malformed = |problem| SettingsError::Malformed { path: path.to_owned(), problem };
        let settings: Self =
            toml::from_str(&text).map_err(|error| malformed(error.to_string().trim_end().to_owned()))?;
        let within = |key: &str, value: u64, range: RangeInclusive<u64>| match range.contains(&value) {
            true => Ok(()),
            false => Err(malformed(format!("{key}: is {value}, not {} to {}", range.start(), range.end()))),
        };
        within("frames_every", settings.frames_every, 1..=1000)?;
        within("commands_every", settings.commands_every, 1..=1000)?;
        within("truth_every", settings.truth_every, 1..=1000)?;
        within("scene_every", settings.scene_every, 10..=1000)?;
        Ok(settings)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn the_shipped_settings_are_read_and_others_are_refused_with_what_is_expected() {
        let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/recorder.toml");
        assert_eq!(RecorderSettings::load(&shipped).unwrap().frames_every, 50);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("recorder.toml");
        let text = std::fs::read_to_string(shipped).unwrap();
        let refused = |from: &str, to: &str| {
            std::fs::write(&path, text.replace(from, to)).unwrap();
            RecorderSettings::load(&path).unwrap_err().to_string()
        };
        assert!(
            refused("frames_every = 50", "frames_every = 0").contains("frames_every: is 0, not 1 to 1000")
        );
        assert!(refused("frames_every = 50", "").contains("missing field `frames_every`"));
        assert!(refused("frames_every", "frame_every").contains("frame_every"));
    }
}
