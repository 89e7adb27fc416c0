use anyhow::Result;
use owo_colors::{OwoColorize, Stream};
use std::process::ExitCode;

/// Bad usage, configuration or input.
const REFUSED: u8 = 2;

/// Logs go to standard error, where results are not.
pub fn begin() {
    tracing_subscriber::fmt()
        .with_writer(std::io::stderr)
        .with_env_filter(
            tracing_subscriber::EnvFilter::builder()
                .with_default_directive(tracing::Level::WARN.into())
                .from_env_lossy(),
        )
        .without_time()
        .with_target(false)
        .init();
}

/// The exit status of a command; an error is told first.
pub fn end(outcome: Result<ExitCode>) -> ExitCode {
    outcome.unwrap_or_else(|error| {
        eprintln!("{} {error:#}", "error:".if_supports_color(Stream::Stderr, |text| text.red()));
        ExitCode::from(REFUSED)
    })
}
