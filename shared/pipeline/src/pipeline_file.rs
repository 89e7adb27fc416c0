//! From the text of a process table to a [`Pipeline`], with the place of every mistake.

use crate::{Pipeline, PipelineError, ProcessEntry, RestartPolicy, Trigger};
use coact_period::PERIOD;
use serde::Deserialize;
use std::{path::Path, time::Duration};
use toml::Spanned;

/// How long a process may take until it is ready. Loading task and robot takes a second at most; the rest is for a slow
/// disk. Chosen by hand; not sensitive.
const READY_WITHIN: Duration = Duration::from_secs(10);
/// How long a process may take to end after SIGTERM. A stage ends within a cycle; chosen by hand; not sensitive.
const STOP_GRACE: Duration = Duration::from_secs(1);
/// What a table without `[restart]` gets. A trade-off, chosen by hand: five restarts in half a minute repair what happens
/// once in a while, and end a process that dies of its input or its configuration.
const RESTART: RestartPolicy = RestartPolicy {
    intensity: 5,
    window: Duration::from_secs(30),
    backoff_initial: Duration::from_millis(10),
    backoff_max: Duration::from_secs(2),
    hung_after: Duration::from_millis(100),
};
/// A shorter silence would take a process for hung that is a few cycles late: after a fault, a stall, or when peers join.
/// Chosen by hand.
const SHORTEST_HUNG_AFTER: Duration = Duration::from_millis(5);
/// A longer window would remember restarts that have nothing to do with each other.
const LONGEST_WINDOW: Duration = Duration::from_secs(24 * 3600);
/// Nobody comes any more who has not come within an hour; the machine would be kept busy by a set that does nothing.
const LONGEST_ADOPTABLE: Duration = Duration::from_secs(3600);
/// A name becomes part of topic names and of the names of sockets, of which the system takes 108 bytes.
const LONGEST_NAME: usize = 32;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PipelineText {
    #[serde(default)]
    restart: RestartText,
    #[serde(default)]
    supervision: SupervisionText,
    process: Vec<ProcessText>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, default)]
struct RestartText {
    intensity: u32,
    window_s: Spanned<f64>,
    backoff_initial_ms: u64,
    backoff_max_ms: u64,
    hung_after_ms: Spanned<u64>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct SupervisionText {
    adoptable_for_s: Option<Spanned<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ProcessText {
    name: Spanned<String>,
    program: String,
    order: u32,
    needed: Option<bool>,
    #[serde(default)]
    on_request: bool,
    #[serde(default)]
    realtime: bool,
    priority: Option<Spanned<u8>>,
    core: Option<usize>,
    #[serde(default)]
    standby: bool,
    spare: Option<Spanned<bool>>,
    trigger: Option<String>,
    latest_start_us: Option<Spanned<u64>>,
    ready_within_ms: Option<u64>,
    stop_grace_ms: Option<u64>,
}

impl Default for RestartText {
    fn default() -> Self {
        let milliseconds = |duration: Duration| duration.as_millis() as u64;
        Self {
            intensity: RESTART.intensity,
            window_s: Spanned::new(0..0, RESTART.window.as_secs_f64()),
            backoff_initial_ms: milliseconds(RESTART.backoff_initial),
            backoff_max_ms: milliseconds(RESTART.backoff_max),
            hung_after_ms: Spanned::new(0..0, milliseconds(RESTART.hung_after)),
        }
    }
}

/// Knows the text, to turn byte offsets into lines.
struct Source<'a> {
    text: &'a str,
    file: &'a Path,
}

/// Keys that a table had before, and why it has them no more.
const REMOVED: [(&str, &str); 2] = [
    ("period_us", "the period is 1 ms, a constant"),
    ("deadline_us", "the deadline is one period after the release, a constant"),
];

impl Pipeline {
    /// Reads a process table from `text`; `file` is only named in errors.
    ///
    /// # Errors
    /// As [`Pipeline::load`].
    pub fn parse(text: &str, file: &Path) -> Result<Self, PipelineError> {
        let source = Source { text, file };
        source.refuse_removed_keys()?;
        let raw: PipelineText = toml::from_str(text).map_err(|error| source.refused(&error))?;
        let restart = source.restart(&raw.restart)?;
        let adoptable_for = source.adoptable_for(&raw.supervision)?;
        let mut processes = Vec::with_capacity(raw.process.len());
        for entry in raw.process {
            let has_standby = entry.standby;
            let process = source.process(entry, &processes)?;
            let standby = has_standby.then(|| process.standby());
            processes.extend(std::iter::once(process).chain(standby));
        }
        processes.sort_by_key(|entry| entry.order);
        Ok(Self { restart, adoptable_for, processes })
    }
}

impl Source<'_> {
    fn restart(&self, raw: &RestartText) -> Result<RestartPolicy, PipelineError> {
        let window_s = *raw.window_s.get_ref();
        if !(window_s > 0.0 && window_s <= LONGEST_WINDOW.as_secs_f64()) {
            return Err(self.error(&raw.window_s, "window_s", window_s, "seconds, above 0, at most a day"));
        }
        let hung_after = Duration::from_millis(*raw.hung_after_ms.get_ref());
        if hung_after < SHORTEST_HUNG_AFTER {
            let expected = format!("at least {}", SHORTEST_HUNG_AFTER.as_millis());
            return Err(self.error(&raw.hung_after_ms, "hung_after_ms", hung_after.as_millis(), &expected));
        }
        Ok(RestartPolicy {
            intensity: raw.intensity,
            window: Duration::from_secs_f64(window_s),
            backoff_initial: Duration::from_millis(raw.backoff_initial_ms),
            backoff_max: Duration::from_millis(raw.backoff_max_ms),
            hung_after,
        })
    }

    /// Zero where the table says nothing: whoever does not know of it expects that the set ends with its supervisor.
    fn adoptable_for(&self, raw: &SupervisionText) -> Result<Duration, PipelineError> {
        let Some(value) = &raw.adoptable_for_s else { return Ok(Duration::ZERO) };
        let (seconds, most) = (*value.get_ref(), LONGEST_ADOPTABLE.as_secs());
        if !(0.0..=most as f64).contains(&seconds) {
            return Err(self.error(value, "adoptable_for_s", seconds, &format!("0 to {most}, seconds")));
        }
        Ok(Duration::from_secs_f64(seconds))
    }

    fn process(&self, raw: ProcessText, before: &[ProcessEntry]) -> Result<ProcessEntry, PipelineError> {
        let name = self.name(&raw.name, before)?;
        let priority = self.priority(&raw, &name)?;
        let trigger = match raw.trigger.as_deref() {
            Some("timer") => Trigger::Timer,
            Some(topic) => Trigger::Topic(topic.to_owned()),
            None => Trigger::None,
        };
        let latest_start = self.latest_start(&raw, &name, &trigger)?;
        let spare = self.spare(&raw, &trigger)?;
        Ok(ProcessEntry {
            name,
            program: raw.program,
            order: raw.order,
            needed: raw.needed.unwrap_or(true),
            on_request: raw.on_request,
            realtime: raw.realtime,
            priority,
            standby_of: None,
            spare,
            core: raw.core,
            trigger,
            latest_start,
            ready_within: raw.ready_within_ms.map_or(READY_WITHIN, Duration::from_millis),
            stop_grace: raw.stop_grace_ms.map_or(STOP_GRACE, Duration::from_millis),
        })
    }

    /// 0 for a process that is not real time and has none.
    fn priority(&self, raw: &ProcessText, name: &str) -> Result<u8, PipelineError> {
        match &raw.priority {
            Some(value) if !(1..=99).contains(value.get_ref()) => {
                Err(self.error(value, "priority", value.get_ref(), "1 to 99"))
            }
            Some(value) => Ok(*value.get_ref()),
            None if raw.realtime => {
                let expected = "a key \"priority\" (1 to 99) beside realtime = true";
                Err(self.error(&raw.name, "name", name, expected))
            }
            None => Ok(0),
        }
    }

    fn spare(&self, raw: &ProcessText, trigger: &Trigger) -> Result<bool, PipelineError> {
        match &raw.spare {
            Some(value) if *value.get_ref() && *trigger == Trigger::None => {
                Err(self.error(value, "spare", true, "false of a process without a trigger"))
            }
            value => Ok(value.as_ref().is_some_and(|value| *value.get_ref())),
        }
    }

    fn latest_start(
        &self,
        raw: &ProcessText,
        name: &str,
        trigger: &Trigger,
    ) -> Result<Duration, PipelineError> {
        let value = raw.latest_start_us.as_ref();
        let latest_start = value.map_or(Duration::ZERO, |value| Duration::from_micros(*value.get_ref()));
        if let Some(value) = value.filter(|_| latest_start >= PERIOD) {
            let expected = format!("less than {}, the period", PERIOD.as_micros());
            return Err(self.error(value, "latest_start_us", value.get_ref(), &expected));
        }
        if matches!(trigger, Trigger::Topic(_)) && latest_start.is_zero() {
            let expected = "a key \"latest_start_us\" above 0 beside a topic as trigger";
            return Err(self.error(&raw.name, "name", name, expected));
        }
        Ok(latest_start)
    }

    /// A name becomes part of topic and file names.
    fn name(&self, raw: &Spanned<String>, before: &[ProcessEntry]) -> Result<String, PipelineError> {
        let name = raw.get_ref();
        let simple = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        if name.is_empty() || name.len() > LONGEST_NAME || !name.chars().all(simple) {
            return Err(self.error(raw, "name", name, &format!("1 to {LONGEST_NAME} of a-z, 0-9 and -")));
        }
        if before.iter().any(|entry| &entry.name == name) {
            return Err(self.error(raw, "name", name, "a name that no process above has"));
        }
        Ok(name.clone())
    }

    fn error<T>(
        &self,
        at: &Spanned<T>,
        key: &str,
        value: impl std::fmt::Display,
        expected: &str,
    ) -> PipelineError {
        PipelineError::Invalid {
            file: self.file.to_owned(),
            line: self.line(at.span().start),
            key: format!("{key}: "),
            problem: format!("is {value}"),
            expected: expected.to_owned(),
        }
    }

    /// Tables of earlier versions have keys that set nothing any more: the answer says so, and what to do.
    fn refuse_removed_keys(&self) -> Result<(), PipelineError> {
        for (line, text) in (1..).zip(self.text.lines()) {
            // Behind the first table's head a key is that table's own.
            if text.trim_start().starts_with('[') {
                break;
            }
            let key = text.split_once('=').map(|(key, _)| key.trim());
            if let Some((key, reason)) = REMOVED.into_iter().find(|(removed, _)| key == Some(*removed)) {
                return Err(PipelineError::Invalid {
                    file: self.file.to_owned(),
                    line,
                    key: format!("{key}: "),
                    problem: format!("is not a setting: {reason}"),
                    expected: "no such key: remove it".to_owned(),
                });
            }
        }
        Ok(())
    }

    /// The parser's own error, with the place. Its message contains what it expected, where it knows.
    fn refused(&self, error: &toml::de::Error) -> PipelineError {
        let offset = error.span().map_or(0, |span| span.start);
        let line = self.line(offset);
        let key =
            self.text.lines().nth(line - 1).and_then(|text| text.split_once('=')).map(|(key, _)| key.trim());
        let (problem, expected) = match error.message().split_once(", expected ") {
            Some((problem, expected)) => (problem, expected),
            None => (error.message(), "what rt-config/pipeline.toml shows"),
        };
        PipelineError::Invalid {
            file: self.file.to_owned(),
            line,
            key: key.map_or_else(String::new, |key| format!("{key}: ")),
            problem: problem.trim_end().to_owned(),
            expected: expected.trim_end().to_owned(),
        }
    }

    fn line(&self, offset: usize) -> usize {
        self.text.as_bytes()[..offset.min(self.text.len())].iter().filter(|&&byte| byte == b'\n').count() + 1
    }
}
