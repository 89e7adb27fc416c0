//! Files that a user names, read without trusting them: only regular files, only so much of them, only text.
//!
//! A device that never ends cannot eat the memory, a pipe that nobody writes cannot hang the reader, and what is no text is
//! said to be none, with the place of the first bad byte.
//!
//! ```
//! use std::path::Path;
//!
//! let problem = coact_input_file::read_text(Path::new("/dev/zero")).unwrap_err();
//! assert_eq!(problem.to_string(), "is a device; expected a regular file");
//! ```

mod files;

pub use files::Files;
use rustix::fs::OFlags;
use std::fs::{File, OpenOptions};
use std::io::{Error, ErrorKind, Read};
use std::os::unix::fs::{FileTypeExt, OpenOptionsExt};
use std::path::Path;

/// No configuration is longer, bytes: five hundred times the longest one that is shipped.
pub const LONGEST_TEXT: u64 = 16 << 20;
/// No log of a run is longer, bytes: of some days of ten-minute runs' events.
pub const LONGEST_LOG: u64 = 1 << 30;

/// Opens a regular file to read, without waiting for anybody.
///
/// # Errors
/// What the system says, or what the file is instead.
pub fn open(path: &Path) -> Result<File, Error> {
    let flags = OFlags::NONBLOCK | OFlags::NOCTTY;
    let file = OpenOptions::new().read(true).custom_flags(flags.bits() as i32).open(path)?;
    let found = file.metadata()?.file_type();
    if found.is_file() {
        return Ok(file);
    }
    let what = match found {
        _ if found.is_dir() => "a folder",
        _ if found.is_fifo() => "a pipe",
        _ if found.is_socket() => "a socket",
        _ => "a device",
    };
    Err(refused(format!("is {what}; expected a regular file")))
}

/// Reads a configuration: UTF-8, at most [`LONGEST_TEXT`] bytes.
///
/// # Errors
/// As [`read_text_within`].
pub fn read_text(path: &Path) -> Result<String, Error> {
    read_text_within(path, LONGEST_TEXT)
}

/// Reads a text of at most so many bytes.
///
/// # Errors
/// What the system says, or why the file is no such text. The message does not name the file.
pub fn read_text_within(path: &Path, longest: u64) -> Result<String, Error> {
    let bytes = read_within(path, longest)?;
    String::from_utf8(bytes).map_err(|error| {
        let good = error.utf8_error().valid_up_to();
        let line = 1 + error.as_bytes()[..good].iter().filter(|&&byte| byte == b'\n').count();
        refused(format!("is no text: byte {good}, on line {line}, is not UTF-8; expected a text file"))
    })
}

/// Reads a file of at most so many bytes.
///
/// # Errors
/// As [`read_text_within`].
pub fn read_within(path: &Path, longest: u64) -> Result<Vec<u8>, Error> {
    if let Some(given) = files::given(path, longest) {
        return given;
    }
    let mut bytes = Vec::new();
    // One byte more tells a file that is too long from one that is just as long as allowed.
    open(path)?.take(longest + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > longest {
        return Err(refused(format!("is longer than {longest} bytes; expected a shorter file")));
    }
    files::note(path, &bytes);
    Ok(bytes)
}

/// Whether there is such a file: a regular one, or one of the [`Files`] that are given.
pub fn exists(path: &Path) -> bool {
    files::given(path, u64::MAX).map_or_else(|| path.is_file(), |given| given.is_ok())
}

fn refused(problem: String) -> Error {
    Error::new(ErrorKind::InvalidData, problem)
}
