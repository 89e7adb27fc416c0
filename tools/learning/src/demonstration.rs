use crate::LearnError;
use coact_run_records::{Event, Record, RunLog};
use serde::Deserialize;
use std::collections::HashSet;
use std::path::Path;

/// One whole assembly as it was perceived: which subgoal was achieved when.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Demonstration {
    /// Where it was read, in words.
    pub source: String,
    /// Every subgoal once, by time.
    pub steps: Vec<Step>,
}

/// A subgoal that was perceived to be achieved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// Time from the start, ms.
    pub at_ms: u64,
    /// Index of the subgoal.
    pub subgoal: usize,
}

/// A step as files name it.
struct NamedStep {
    place: String,
    at_ms: u64,
    name: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TomlFile {
    achieved: Vec<Entry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    seconds: f64,
    subgoal: String,
}

impl Demonstration {
    /// Reads what `path` holds, for subgoals of the names `known`, by their index: a `.toml` file with a table
    /// `[[achieved]]` (keys `seconds`, `subgoal`) or a `.csv` file with columns of these names holds one demonstration;
    /// a report folder or its `events.jsonl` holds one for each completed assembly.
    ///
    /// # Errors
    /// A file that cannot be read as such, an unknown subgoal, one that is achieved twice or never.
    pub fn read(path: &Path, known: &[String]) -> Result<Vec<Self>, LearnError> {
        let path = if path.is_dir() { path.join(Event::FILE) } else { path.to_owned() };
        let name = path.display().to_string();
        let text = || {
            coact_input_file::read_text(&path).map_err(|cause| LearnError::File { path: path.clone(), cause })
        };
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("toml") => Ok(vec![Self::new(&name, entries_of_toml(&name, &text()?)?, known)?]),
            Some("csv") => Ok(vec![Self::new(&name, entries_of_csv(&name, &text()?)?, known)?]),
            Some("jsonl") => Self::of_report(&name, RunLog::read_file(&path)?, known),
            _ => Err(LearnError::content(
                name,
                "expected a demonstration: a .toml or .csv file, a report folder or its events.jsonl",
            )),
        }
    }

    fn new(source: &str, named: Vec<NamedStep>, known: &[String]) -> Result<Self, LearnError> {
        let mut steps = Vec::new();
        let mut seen = HashSet::new();
        for NamedStep { place, at_ms, name } in named {
            let subgoal = known.iter().position(|own| *own == name).ok_or_else(|| {
                let names: Vec<_> = known.iter().map(|name| format!("{name:?}")).collect();
                let problem =
                    format!("{name:?} is no subgoal of the task; expected one of {}", names.join(", "));
                LearnError::content(&place, problem)
            })?;
            if !seen.insert(subgoal) {
                let problem = format!("{name:?} is achieved a second time; expected every subgoal once");
                return Err(LearnError::content(&place, problem));
            }
            steps.push(Step { at_ms, subgoal });
        }
        if let Some(missing) = (0..known.len()).find(|subgoal| !seen.contains(subgoal)) {
            let problem = format!("{:?} is never achieved; expected the whole assembly", known[missing]);
            return Err(LearnError::content(source, problem));
        }
        steps.sort_by_key(|step| step.at_ms);
        Ok(Self { source: source.into(), steps })
    }

    /// One demonstration for each assembly that was completed, as the robot perceived it; one that was broken off is left out.
    fn of_report(name: &str, events: Vec<Event>, known: &[String]) -> Result<Vec<Self>, LearnError> {
        let mut assemblies: Vec<(u64, Vec<NamedStep>)> = Vec::new();
        for (line, event) in (1..).zip(events) {
            let place = format!("{name}:{line}");
            let Event::Perceived { at_ms, assembly, name, .. } = event else { continue };
            if assemblies.last().is_none_or(|(last, _)| *last != assembly) {
                assemblies.push((assembly, Vec::new()));
            }
            if let Some((_, steps)) = assemblies.last_mut() {
                steps.push(NamedStep { place, at_ms, name });
            }
        }
        if assemblies.len() > 1 && assemblies.last().is_some_and(|(_, steps)| steps.len() < known.len()) {
            assemblies.pop();
        }
        if assemblies.is_empty() {
            return Err(LearnError::content(
                name,
                "no subgoal was perceived to be achieved in this run; expected an assembly",
            ));
        }
        let demonstration =
            |(assembly, steps)| Self::new(&format!("{name} (assembly {})", assembly + 1), steps, known);
        assemblies.into_iter().map(demonstration).collect()
    }
}

fn entries_of_toml(name: &str, text: &str) -> Result<Vec<NamedStep>, LearnError> {
    let file: TomlFile = toml::from_str(text).map_err(|error| {
        let start = error.span().map_or(0, |span| span.start);
        let line = 1 + text.bytes().take(start).filter(|&byte| byte == b'\n').count();
        LearnError::content(format!("{name}:{line}"), error.message().trim())
    })?;
    let named = |(index, entry)| named(format!("{name}: achieved[{index}]"), entry);
    file.achieved.into_iter().enumerate().map(named).collect()
}

fn entries_of_csv(name: &str, text: &str) -> Result<Vec<NamedStep>, LearnError> {
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let entry = |(index, entry): (usize, Result<Entry, csv::Error>)| {
        let place = format!("{name}:{}", index + 2);
        match entry {
            Ok(entry) => named(place, entry),
            Err(error) => {
                let problem = format!("{error}; expected columns seconds,subgoal");
                Err(LearnError::content(place, problem))
            }
        }
    };
    reader.deserialize().enumerate().map(entry).collect()
}

fn named(place: String, Entry { seconds, subgoal }: Entry) -> Result<NamedStep, LearnError> {
    if !(0.0..1e6).contains(&seconds) {
        let problem = format!("seconds is {seconds}; expected a time from the start, 0 to 1000000");
        return Err(LearnError::content(place, problem));
    }
    Ok(NamedStep { place, at_ms: (seconds * 1e3).round() as u64, name: subgoal })
}
