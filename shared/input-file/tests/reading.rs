//! Whatever is named, the reader ends, and says why it does not read it.
#![allow(clippy::unwrap_used)]

use coact_input_file::{read_text, read_text_within};
use proptest::prelude::*;
use rustix::fs::{CWD, FileType, Mode, mknodat};
use std::os::unix::net::UnixListener;
use std::path::Path;

fn problem(path: &Path) -> String {
    read_text(path).unwrap_err().to_string()
}

#[test]
fn what_is_no_regular_file_is_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let (pipe, socket) = (folder.path().join("pipe"), folder.path().join("socket"));
    mknodat(CWD, &pipe, FileType::Fifo, Mode::RUSR | Mode::WUSR, 0).unwrap();
    let _listener = UnixListener::bind(&socket).unwrap();
    assert_eq!(problem(&pipe), "is a pipe; expected a regular file");
    assert_eq!(problem(folder.path()), "is a folder; expected a regular file");
    assert_eq!(problem(Path::new("/dev/zero")), "is a device; expected a regular file");
    assert!(read_text(&socket).is_err());
    assert!(problem(&folder.path().join("none")).contains("No such file"));
}

#[test]
fn a_file_may_be_as_long_as_allowed_and_no_longer() {
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), "abcd").unwrap();
    assert_eq!(read_text_within(file.path(), 4).unwrap(), "abcd");
    let problem = read_text_within(file.path(), 3).unwrap_err().to_string();
    assert!(problem.contains("longer than 3 bytes"), "{problem}");
}

#[test]
fn bytes_that_are_no_text_are_named_with_their_place() {
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), b"one\ntwo\xff").unwrap();
    let problem = problem(file.path());
    assert!(problem.contains("byte 7, on line 2"), "{problem}");
}

proptest! {
    #[test]
    fn any_bytes_are_read_as_they_are_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..2000)) {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), &bytes).unwrap();
        match (read_text(file.path()), String::from_utf8(bytes)) {
            (Ok(read), Ok(written)) => prop_assert_eq!(read, written),
            (Err(_), Err(_)) => {}
            (read, _) => prop_assert!(false, "{:?}", read),
        }
    }
}
