//! What is trusted: directories and files of the calling user that nobody else can write to or read.

use crate::RunError;
use rustix::process::geteuid;
use std::fs::Metadata;
use std::io;
use std::os::unix::fs::MetadataExt;
use std::path::Path;

/// Refuses a directory that another user owns or can enter, and what is none.
pub(crate) fn directory(path: &Path) -> Result<(), RunError> {
    check(path, Metadata::is_dir, "a directory")
}

/// Refuses a file that another user owns or can open, and what is none.
pub(crate) fn file(path: &Path) -> Result<(), RunError> {
    check(path, Metadata::is_file, "a file")
}

/// Whether the calling user owns it; symbolic links are not followed.
pub(crate) fn is_own(path: &Path) -> io::Result<bool> {
    Ok(std::fs::symlink_metadata(path)?.uid() == geteuid().as_raw())
}

fn check(path: &Path, is_kind: impl Fn(&Metadata) -> bool, kind: &'static str) -> Result<(), RunError> {
    let metadata = std::fs::symlink_metadata(path).map_err(|cause| RunError::File {
        path: path.to_owned(),
        operation: "cannot be read",
        cause,
    })?;
    let problem = if !is_kind(&metadata) {
        format!("is not {kind}")
    } else if metadata.uid() != geteuid().as_raw() {
        format!("belongs to user {}", metadata.uid())
    } else if metadata.mode() & 0o077 != 0 {
        format!("is open to others (mode {:o})", metadata.mode() & 0o777)
    } else {
        return Ok(());
    };
    Err(RunError::Untrusted { path: path.to_owned(), problem, kind })
}
