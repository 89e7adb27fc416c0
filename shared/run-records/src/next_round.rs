use coact_pipeline::Layout;
use serde::{Deserialize, Serialize};
use std::io::{ErrorKind, Write};
use std::os::unix::fs::OpenOptionsExt;
use std::path::{Path, PathBuf};

/// Another run that somebody at a page wants after this one: of which task, how it is laid out, and at which address its console is to be found.
///
/// Whoever ends the run leaves it in the report's folder; `coact launch` takes it from there.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct NextRound {
    /// The task's file.
    pub task: PathBuf,
    /// Where its parts lie.
    pub layout: Layout,
    /// Port and token of its console: the page that asked for it looks for it there.
    pub port: u16,
    /// See `port`.
    pub token: String,
}

impl NextRound {
    /// Name of the file.
    const FILE: &str = "next-round.json";

    /// Leaves it in a report's folder, readable by its user alone: it holds a token.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn leave(&self, report: &Path) -> std::io::Result<()> {
        let path = report.join(Self::FILE);
        std::fs::remove_file(&path).or_else(|error| match error.kind() {
            ErrorKind::NotFound => Ok(()),
            _ => Err(error),
        })?;
        let mut file = std::fs::OpenOptions::new().write(true).create_new(true).mode(0o600).open(path)?;
        file.write_all(&serde_json::to_vec(self)?)
    }

    /// Takes it from there; none where nobody has left any.
    ///
    /// # Errors
    /// It cannot be read or removed, or is none.
    pub fn take(report: &Path) -> std::io::Result<Option<Self>> {
        let path = report.join(Self::FILE);
        let text = match coact_input_file::read_text(&path) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            read => read?,
        };
        std::fs::remove_file(&path)?;
        Ok(Some(serde_json::from_str(&text)?))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use std::os::unix::fs::PermissionsExt;

    #[test]
    fn what_is_left_is_taken_once_and_nobody_else_can_read_it() {
        let report = tempfile::tempdir().unwrap();
        assert_eq!(NextRound::take(report.path()).unwrap(), None);
        let next = NextRound {
            task: "a.toml".into(),
            layout: Layout::Random(5),
            port: 7411,
            token: "secret".into(),
        };
        next.leave(report.path()).unwrap();
        next.leave(report.path()).unwrap();
        let mode = report.path().join(NextRound::FILE).metadata().unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o600);
        assert_eq!(NextRound::take(report.path()).unwrap(), Some(next));
        assert_eq!(NextRound::take(report.path()).unwrap(), None);
    }
}
