use crate::WorldError;
use coact_joint_task::Task;
use coact_period::CYCLES_PER_SECOND;
use std::path::Path;
use toml::Spanned;

/// The text of a scenario and what its errors need.
pub(super) struct ScenarioSource<'a> {
    pub path: &'a Path,
    pub text: &'a str,
    pub task: &'a Task,
}

impl ScenarioSource<'_> {
    pub fn cycles(&self, key: &str, seconds: &Spanned<f64>) -> Result<u64, WorldError> {
        let value = *seconds.as_ref();
        if !(0.0..=86_400.0).contains(&value) {
            let message = format!("key \"{key}\": {value} is out of range; expected seconds from 0 to 86400");
            return Err(self.fault(seconds.span().start, message));
        }
        Ok((value * CYCLES_PER_SECOND as f64).round() as u64)
    }

    pub fn kind(&self, key: &str, name: &Spanned<String>) -> Result<usize, WorldError> {
        let known: Vec<&str> = self.task.kinds.iter().map(|kind| kind.name.as_str()).collect();
        self.find(key, name, &known)
    }

    pub fn subgoal(&self, key: &str, name: &Spanned<String>) -> Result<usize, WorldError> {
        let known: Vec<&str> = self.task.subgoals.iter().map(|goal| goal.name.as_str()).collect();
        self.find(key, name, &known)
    }

    /// Index of `name` among the `known` ones.
    pub fn find(&self, key: &str, name: &Spanned<String>, known: &[&str]) -> Result<usize, WorldError> {
        known.iter().position(|own| own == name.as_ref()).ok_or_else(|| {
            let message =
                format!("key \"{key}\": \"{}\" is unknown; expected one of {known:?}", name.as_ref());
            self.fault(name.span().start, message)
        })
    }

    /// A mistake at byte `at`.
    pub fn fault(&self, at: usize, message: String) -> WorldError {
        let line = 1 + self.text[..at.min(self.text.len())].matches('\n').count();
        WorldError::Scenario { path: self.path.to_path_buf(), line, message }
    }
}
