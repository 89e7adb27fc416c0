use serde::{Serialize, de::DeserializeOwned};
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// A file of JSON lines: every entry is on disk as soon as it was made, and read back after a restart.
#[derive(Debug)]
pub struct Journal<T> {
    file: File,
    entries: Vec<T>,
}

/// Why the journal could not be used.
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    /// The file could not be read or written.
    #[error("{path}: {cause}")]
    File {
        /// Of the journal.
        path: PathBuf,
        /// What the system said.
        cause: std::io::Error,
    },
    /// A line is no entry of this journal.
    #[error("{path}:{line}: not an entry of this program: {cause}; move the report away or name another one")]
    Line {
        /// Of the journal.
        path: PathBuf,
        /// Where, counted from 1.
        line: usize,
        /// What is wrong with it.
        cause: serde_json::Error,
    },
}

impl<T: Serialize + DeserializeOwned> Journal<T> {
    /// Opens the journal at `path`. A line that a killed predecessor could not finish is cut off.
    ///
    /// # Errors
    /// The file cannot be read or written, or holds something else.
    pub fn open(path: &Path) -> Result<Self, JournalError> {
        let error = |cause| JournalError::File { path: path.to_owned(), cause };
        let file = OpenOptions::new().create(true).append(true).open(path).map_err(error)?;
        let text = std::fs::read_to_string(path).map_err(error)?;
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        if whole < text.len() {
            file.set_len(whole as u64).map_err(error)?;
        }
        Ok(Self { file, entries: entries(path, &text[..whole])? })
    }

    /// Reads a journal that nobody writes any more; a last line without its end is left out.
    ///
    /// # Errors
    /// The file cannot be read, or holds something else.
    pub fn read(path: &Path) -> Result<Vec<T>, JournalError> {
        let text = std::fs::read_to_string(path)
            .map_err(|cause| JournalError::File { path: path.to_owned(), cause })?;
        entries(path, &text[..text.rfind('\n').map_or(0, |end| end + 1)])
    }

    /// Every entry of the run so far.
    pub fn entries(&self) -> &[T] {
        &self.entries
    }

    /// Appends entries.
    ///
    /// # Errors
    /// The file cannot be written; the entries are kept in memory all the same.
    pub fn append(&mut self, entries: Vec<T>) -> std::io::Result<()> {
        let mut text = String::new();
        for entry in &entries {
            text.push_str(&serde_json::to_string(entry)?);
            text.push('\n');
        }
        self.entries.extend(entries);
        self.file.write_all(text.as_bytes())
    }
}

fn entries<T: DeserializeOwned>(path: &Path, whole: &str) -> Result<Vec<T>, JournalError> {
    let entry = |(number, line)| {
        serde_json::from_str(line).map_err(|cause| JournalError::Line {
            path: path.to_owned(),
            line: number + 1,
            cause,
        })
    };
    whole.lines().enumerate().map(entry).collect()
}
