/// Why the whole set was given up.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{process}: {reason}{}", quoted(.stderr_tail))]
pub struct GaveUp {
    /// Name of the process.
    pub process: String,
    /// What happened to it and why it was not started again.
    pub reason: String,
    /// Its last lines on standard error.
    pub stderr_tail: Vec<String>,
    /// True when it refused to start at all: what it was given is at fault, and starting it again cannot help.
    pub configuration: bool,
}

/// The lines, indented below the reason.
fn quoted(lines: &[String]) -> String {
    lines.iter().map(|line| format!("\n    {line}")).collect()
}
