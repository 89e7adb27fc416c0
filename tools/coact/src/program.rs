use anyhow::Result;
use coact_realtime::LogStyle;
use owo_colors::{OwoColorize, Stream};
use std::process::ExitCode;

/// Bad usage, configuration or input.
const REFUSED: u8 = 2;

/// Logs go to standard error, where results are not.
pub fn begin() {
    LogStyle::Tool.log_to_stderr();
}

/// The exit status of a command; an error is told first.
pub fn end(outcome: Result<ExitCode>) -> ExitCode {
    outcome.unwrap_or_else(|error| {
        eprintln!("{} {error:#}", "error:".if_supports_color(Stream::Stderr, |text| text.red()));
        ExitCode::from(REFUSED)
    })
}
