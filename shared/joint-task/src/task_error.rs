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

impl TaskError {
    /// The same error of a network file, which also names the task file that asks for the network: what does not go together
    /// may be mistaken in either.
    pub(crate) fn with_task(self, task: &std::path::Path) -> Self {
        Self { problem: format!("{} (the network of {})", self.problem, task.display()), ..self }
    }
}
