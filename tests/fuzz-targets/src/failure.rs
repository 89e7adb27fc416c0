/// A target did with some input what it must never do.
#[derive(Debug, Clone, PartialEq)]
pub struct Failure {
    /// The target.
    pub target: &'static str,
    /// What it did.
    pub problem: String,
    /// The input.
    pub input: Vec<u8>,
}

impl std::fmt::Display for Failure {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        const SHOWN: usize = 200;
        let begin = &self.input[..self.input.len().min(SHOWN)];
        let (target, problem, length) = (self.target, &self.problem, self.input.len());
        write!(out, "{target}: {problem}, with {length} bytes: {}", begin.escape_ascii())
    }
}

impl std::error::Error for Failure {}
