use crate::SafetyError;
use std::ops::RangeInclusive;
use std::path::Path;
use toml::Spanned;

/// What is wrong, and at which byte of the text.
#[derive(Debug)]
pub(crate) struct Fault {
    pub at: usize,
    pub problem: String,
}

impl Fault {
    /// The error, with file and line.
    pub fn in_file(self, text: &str, file: &Path) -> SafetyError {
        let line =
            1 + text.as_bytes()[..self.at.min(text.len())].iter().filter(|byte| **byte == b'\n').count();
        SafetyError::Invalid { file: file.to_owned(), line, problem: self.problem }
    }
}

/// The value of `key`, if it lies in the range; NaN and infinities lie in none.
pub(crate) fn within<T: PartialOrd + Copy + std::fmt::Display>(
    key: &str,
    value: &Spanned<T>,
    range: RangeInclusive<T>,
) -> Result<T, Fault> {
    let number = *value.get_ref();
    if range.contains(&number) {
        return Ok(number);
    }
    let problem = format!("{key} = {number}; expected {} to {}", range.start(), range.end());
    Err(Fault { at: value.span().start, problem })
}
