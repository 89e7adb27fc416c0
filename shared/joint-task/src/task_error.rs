/// Why a task or network file was refused: where it stands, what is wrong and what was expected.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{file}:{line}: {key}: {problem}")]
pub struct TaskError {
    /// The file, as it was named.
    pub file: String,
    /// Line, counted from 1; 0 when the whole file is meant.
    pub line: usize,
    /// The key or table, e.g. `subgoal[2].after`.
    pub key: String,
    /// What is wrong and what was expected.
    pub problem: String,
}
