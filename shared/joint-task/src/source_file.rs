use crate::TaskError;
use std::{ops::Range, path::Path};

/// A file's name and text: turns byte ranges into lines of a [`TaskError`].
pub(crate) struct SourceFile {
    file: String,
    text: String,
}

impl SourceFile {
    pub(crate) fn read(path: &Path) -> Result<Self, TaskError> {
        let file = path.display().to_string();
        match coact_input_file::read_text(path) {
            Ok(text) => Ok(Self { file, text }),
            Err(error) => Err(TaskError { file, line: 0, key: "file".into(), problem: error.to_string() }),
        }
    }

    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// The error of `key` at `span`.
    pub(crate) fn error(
        &self,
        span: Range<usize>,
        key: impl Into<String>,
        problem: impl Into<String>,
    ) -> TaskError {
        let line = 1 + self.text.bytes().take(span.start).filter(|&byte| byte == b'\n').count();
        TaskError { file: self.file.clone(), line, key: key.into(), problem: problem.into() }
    }

    /// Reads the whole text as `T`; a mistake in the TOML itself names its line and the key that the parser names.
    pub(crate) fn parse<T: serde::de::DeserializeOwned>(&self) -> Result<T, TaskError> {
        toml::from_str(&self.text).map_err(|error| {
            let span = error.span().unwrap_or(0..0);
            let problem = error.message().trim().to_string();
            let missing = problem.strip_prefix("missing field `").and_then(|rest| rest.split('`').next());
            let key = missing.map_or_else(|| key_at(&self.text, span.start), str::to_string);
            self.error(span, key, problem)
        })
    }
}

/// The key on the line of byte `at`, or the table header there.
fn key_at(text: &str, at: usize) -> String {
    let start = text[..at.min(text.len())].rfind('\n').map_or(0, |newline| newline + 1);
    let line = text[start..].lines().next().unwrap_or_default();
    line.split('=').next().unwrap_or(line).trim().to_string()
}
