use serde::Deserialize;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

/// How the console serves: `rt-config/console.toml`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ConsoleSettings {
    /// Port on the loopback address; 0: any that is free.
    pub port: u16,
    /// Live pictures in a second.
    pub pictures_per_second: u32,
    /// Pictures of the past that are kept; when there are more, every second one of them is dropped.
    pub pictures_kept: usize,
}

/// Why there are none.
#[derive(Debug, thiserror::Error)]
#[error("{path}: {problem}; expected what rt-config/console.toml shows")]
pub struct SettingsError {
    /// The file.
    path: PathBuf,
    /// What is wrong with it.
    problem: String,
}

impl ConsoleSettings {
    /// Name of the file, beside the process table.
    pub const FILE: &str = "console.toml";

    /// Reads the file.
    ///
    /// # Errors
    /// [`SettingsError`] says what is wrong with it.
    pub fn load(path: &Path) -> Result<Self, SettingsError> {
        let malformed = |problem: String| SettingsError { path: path.to_owned(), problem };
        let text = coact_input_file::read_text(path).map_err(|error| malformed(error.to_string()))?;
        let settings: Self =
            toml::from_str(&text).map_err(|error| malformed(error.to_string().trim_end().to_owned()))?;
        let within = |key: &str, value: usize, range: RangeInclusive<usize>| match range.contains(&value) {
            true => Ok(()),
            false => Err(malformed(format!("{key}: is {value}, not {} to {}", range.start(), range.end()))),
        };
        within("pictures_per_second", settings.pictures_per_second as usize, 1..=60)?;
        within("pictures_kept", settings.pictures_kept, 100..=100_000)?;
        Ok(settings)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn the_shipped_settings_are_read_and_others_are_refused_with_what_is_expected() {
        let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/console.toml");
        let settings = ConsoleSettings::load(&shipped).unwrap();
        assert_eq!(settings.pictures_per_second, 30);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("console.toml");
        let refused = |text: &str| {
            std::fs::write(&path, text).unwrap();
            ConsoleSettings::load(&path).unwrap_err().to_string()
        };
        assert!(
            refused("port = 0\npictures_per_second = 0\npictures_kept = 100").contains("is 0, not 1 to 60")
        );
        assert!(
            refused("port = 0\npictures_per_second = 30\npictures_kept = 1").contains("pictures_kept: is 1")
        );
        assert!(refused("port = 70000\npictures_per_second = 30\npictures_kept = 100").contains("70000"));
        assert!(refused("port = 0").contains("missing field"));
    }
}
