use std::path::PathBuf;

/// Why a robot description was refused.
#[derive(Debug, thiserror::Error)]
pub enum RobotError {
    /// A file could not be read.
    #[error("{path}: cannot be read ({reason}); expected a robot description", path = .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system said.
        reason: std::io::Error,
    },
    /// A URDF or TOML file could not be understood.
    #[error("{path}{at}: {message}", path = .path.display(), at = line_suffix(*.line))]
    Malformed {
        /// The file.
        path: PathBuf,
        /// The line, counted from 1, where it is known.
        line: Option<usize>,
        /// What was found, what was expected, what to do.
        message: String,
    },
}

fn line_suffix(line: Option<usize>) -> String {
    line.map(|line| format!(":{line}")).unwrap_or_default()
}
