use super::script::{Deed, Entry, Script, Start};
use crate::WorldError;
use coact_joint_task::Task;
use serde::Deserialize;
use std::path::Path;
use toml::Spanned;

/// A scenario file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    action: Vec<Spanned<Line>>,
}

/// One `[[action]]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {
    at: Option<Spanned<f64>>,
    after: Option<Spanned<f64>>,
    idle: Option<Spanned<f64>>,
    chain: Option<Spanned<String>>,
    kind: Option<Spanned<String>>,
}

/// The text of a scenario and what its errors need.
struct Source<'a> {
    path: &'a Path,
    text: &'a str,
    task: &'a Task,
}

impl Script {
    /// Reads a scenario: `[[action]]`s, each with `idle` (s) or `chain` and `kind` (names of the task), and when it
    /// is due: `at` (s from the start of the run) or `after` (s after the end of the action before; 0 if not given).
    ///
    /// # Errors
    /// [`WorldError`] with file, line, key and what was expected.
    pub fn load(path: &Path, task: &Task) -> Result<Self, WorldError> {
        let text = std::fs::read_to_string(path)
            .map_err(|source| WorldError::File { path: path.to_path_buf(), source })?;
        let source = Source { path, text: &text, task };
        let file: File = toml::from_str(&text).map_err(|error| {
            let at = error.span().map_or(0, |span| span.start);
            source.fault(
                at,
                format!("{}; expected [[action]] entries as in rt-config/scenarios", error.message()),
            )
        })?;
        let entries = file.action.iter().map(|line| source.entry(line)).collect::<Result<_, _>>()?;
        Ok(Self { entries })
    }
}

impl Source<'_> {
    fn entry(&self, line: &Spanned<Line>) -> Result<Entry, WorldError> {
        let here = line.span().start;
        let Line { at, after, idle, chain, kind } = line.as_ref();
        let start = match (at, after) {
            (Some(at), None) => Start::At(self.ticks("at", at)?),
            (None, Some(after)) => Start::After(self.ticks("after", after)?),
            (None, None) => Start::After(0),
            (Some(at), Some(_)) => {
                return Err(self
                    .fault(at.span().start, "keys \"at\" and \"after\": expected only one of them".into()));
            }
        };
        let deed = match (idle, chain, kind) {
            (Some(idle), None, None) => Deed::Idle(self.ticks("idle", idle)?),
            (None, Some(chain), Some(kind)) => Deed::Chain(self.chain(chain, kind)?),
            (None, Some(chain), None) => {
                return Err(self.fault(chain.span().start, "key \"kind\" is missing beside \"chain\"".into()));
            }
            _ => {
                return Err(self.fault(here, "expected either \"idle\", or \"chain\" with \"kind\"".into()));
            }
        };
        Ok(Entry { start, deed })
    }

    fn ticks(&self, key: &str, seconds: &Spanned<f64>) -> Result<u64, WorldError> {
        let value = *seconds.as_ref();
        if !(0.0..=86_400.0).contains(&value) {
            let message = format!("key \"{key}\": {value} is out of range; expected seconds from 0 to 86400");
            return Err(self.fault(seconds.span().start, message));
        }
        Ok((value * 1000.0).round() as u64)
    }

    fn chain(&self, chain: &Spanned<String>, kind: &Spanned<String>) -> Result<usize, WorldError> {
        let task = self.task;
        let kinds: Vec<&str> = task.kinds.iter().map(|kind| kind.name.as_str()).collect();
        let mut names: Vec<&str> = task.chains.iter().map(|chain| chain.name.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        let unknown = |key: &str, given: &Spanned<String>, known: &[&str]| {
            let message =
                format!("key \"{key}\": \"{}\" is unknown; expected one of {known:?}", given.as_ref());
            self.fault(given.span().start, message)
        };
        if !names.contains(&chain.as_ref().as_str()) {
            return Err(unknown("chain", chain, &names));
        }
        let index = kinds
            .iter()
            .position(|name| name == kind.as_ref())
            .ok_or_else(|| unknown("kind", kind, &kinds))?;
        let fits = |known: &coact_joint_task::Chain| known.name == *chain.as_ref() && known.kind == index;
        task.chains.iter().position(fits).ok_or_else(|| {
            let message = format!("key \"kind\": the task has no chain \"{}\" for it", chain.as_ref());
            self.fault(kind.span().start, message)
        })
    }

    fn fault(&self, at: usize, message: String) -> WorldError {
        let line = 1 + self.text[..at.min(self.text.len())].matches('\n').count();
        WorldError::Scenario { path: self.path.to_path_buf(), line, message }
    }
}
