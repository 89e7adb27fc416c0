//! From the text of a process table to a [`Pipeline`], with the place of every mistake.

use crate::{Pipeline, PipelineError, ProcessEntry, RestartPolicy, Trigger};
use serde::Deserialize;
use std::{path::Path, time::Duration};
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PipelineText {
    #[serde(default = "default_period")]
    period_us: Spanned<u64>,
    deadline_us: Option<Spanned<u64>>,
    #[serde(default)]
    restart: RestartText,
    process: Vec<ProcessText>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, default)]
struct RestartText {
    intensity: u32,
    period_s: Spanned<f64>,
    backoff_initial_ms: u64,
    backoff_max_ms: u64,
    hung_after_ms: Spanned<u64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ProcessText {
    name: Spanned<String>,
    program: String,
    order: u32,
    #[serde(default)]
    realtime: bool,
    priority: Option<Spanned<u8>>,
    core: Option<usize>,
    trigger: Option<String>,
    latest_start_us: Option<Spanned<u64>>,
    #[serde(default = "default_ready_within")]
    ready_within_ms: u64,
    #[serde(default = "default_stop_grace")]
    stop_grace_ms: u64,
}

impl Default for RestartText {
    fn default() -> Self {
        Self {
            intensity: 5,
            period_s: Spanned::new(0..0, 30.0),
            backoff_initial_ms: 10,
            backoff_max_ms: 2000,
            hung_after_ms: Spanned::new(0..0, 500),
        }
    }
}

fn default_period() -> Spanned<u64> {
    Spanned::new(0..0, 1000)
}

fn default_ready_within() -> u64 {
    10_000
}

fn default_stop_grace() -> u64 {
    1000
}

/// Knows the text, to turn byte offsets into lines.
struct Source<'a> {
    text: &'a str,
    file: &'a Path,
}

pub(crate) fn parse(text: &str, file: &Path) -> Result<Pipeline, PipelineError> {
    let source = Source { text, file };
    let raw: PipelineText = toml::from_str(text).map_err(|error| source.refused(&error))?;
    let period_us = *raw.period_us.get_ref();
    if !(100..=1_000_000).contains(&period_us) {
        return Err(source.error(&raw.period_us, "period_us", period_us, "100 to 1000000"));
    }
    let deadline_us = raw.deadline_us.as_ref().map_or(period_us, |value| *value.get_ref());
    if let Some(value) = raw.deadline_us.filter(|value| !(1..=10 * period_us).contains(value.get_ref())) {
        return Err(source.error(&value, "deadline_us", deadline_us, "1 to ten periods"));
    }
    let restart = source.restart(&raw.restart)?;
    let mut processes = Vec::with_capacity(raw.process.len());
    for entry in raw.process {
        processes.push(source.process(entry, period_us, &processes)?);
    }
    processes.sort_by_key(|entry| entry.order);
    Ok(Pipeline { period_us, deadline_us, restart, processes })
}

impl Source<'_> {
    fn restart(&self, raw: &RestartText) -> Result<RestartPolicy, PipelineError> {
        let period_s = *raw.period_s.get_ref();
        if !(period_s > 0.0 && period_s <= 86_400.0) {
            return Err(self.error(&raw.period_s, "period_s", period_s, "seconds, above 0, at most a day"));
        }
        let hung_after_ms = *raw.hung_after_ms.get_ref();
        if hung_after_ms < 50 {
            return Err(self.error(&raw.hung_after_ms, "hung_after_ms", hung_after_ms, "at least 50"));
        }
        Ok(RestartPolicy {
            intensity: raw.intensity,
            period: Duration::from_secs_f64(period_s),
            backoff_initial: Duration::from_millis(raw.backoff_initial_ms),
            backoff_max: Duration::from_millis(raw.backoff_max_ms),
            hung_after: Duration::from_millis(hung_after_ms),
        })
    }

    fn process(
        &self,
        raw: ProcessText,
        period_us: u64,
        before: &[ProcessEntry],
    ) -> Result<ProcessEntry, PipelineError> {
        let name = self.name(&raw.name, before)?;
        if let Some(value) = raw.priority.as_ref().filter(|value| !(1..=99).contains(value.get_ref())) {
            return Err(self.error(value, "priority", value.get_ref(), "1 to 99"));
        }
        if raw.realtime && raw.priority.is_none() {
            return Err(self.error(
                &raw.name,
                "name",
                &name,
                "a key \"priority\" (1 to 99) beside realtime = true",
            ));
        }
        let latest_start_us = raw.latest_start_us.as_ref().map_or(0, |value| *value.get_ref());
        if let Some(value) = raw.latest_start_us.filter(|value| *value.get_ref() >= period_us) {
            return Err(self.error(&value, "latest_start_us", latest_start_us, "less than period_us"));
        }
        let trigger = match raw.trigger.as_deref() {
            Some("timer") => Trigger::Timer,
            Some(topic) => Trigger::Topic(topic.to_owned()),
            None => Trigger::None,
        };
        if matches!(trigger, Trigger::Topic(_)) && latest_start_us == 0 {
            let expected = "a key \"latest_start_us\" above 0 beside a topic as trigger";
            return Err(self.error(&raw.name, "name", &name, expected));
        }
        Ok(ProcessEntry {
            name,
            program: raw.program,
            order: raw.order,
            realtime: raw.realtime,
            priority: raw.priority.map_or(0, Spanned::into_inner),
            core: raw.core,
            trigger,
            latest_start_us,
            ready_within: Duration::from_millis(raw.ready_within_ms),
            stop_grace: Duration::from_millis(raw.stop_grace_ms),
        })
    }

    /// A name becomes part of topic and file names.
    fn name(&self, raw: &Spanned<String>, before: &[ProcessEntry]) -> Result<String, PipelineError> {
        let name = raw.get_ref();
        let simple = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        if name.is_empty() || name.len() > 32 || !name.chars().all(simple) {
            return Err(self.error(raw, "name", name, "1 to 32 of a-z, 0-9 and -"));
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

    /// The parser's own complaint. Its message holds what it expected, where it knows.
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
