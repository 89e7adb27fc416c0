use tracing::level_filters::LevelFilter;
use tracing_subscriber::filter::Targets;
use tracing_subscriber::layer::SubscriberExt;
use tracing_subscriber::util::SubscriberInitExt;
use tracing_subscriber::{Layer, Registry, fmt};

/// The variable that says what is logged: a level, or levels of modules, as in `coact_control=debug,info`.
const VARIABLE: &str = "RUST_LOG";

/// How a line of the log begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LogStyle {
    /// With time and module: of processes, whose logs are read later.
    Process,
    /// With its level alone: of programs that somebody is looking at.
    Tool,
}

impl LogStyle {
    /// From here on, warnings go to standard error, or what `RUST_LOG` asks for.
    pub fn log_to_stderr(self) {
        let wanted = std::env::var(VARIABLE).unwrap_or_default();
        let (filter, refused) = match filter(&wanted) {
            Ok(filter) => (filter, None),
            Err(error) => (Targets::new().with_default(LevelFilter::WARN), Some(error)),
        };
        let lines = fmt::layer::<Registry>().with_writer(std::io::stderr);
        let lines = match self {
            Self::Process => lines.boxed(),
            Self::Tool => lines.without_time().with_target(false).boxed(),
        };
        tracing_subscriber::registry().with(lines.with_filter(filter)).init();
        if let Some(error) = refused {
            tracing::warn!(
                "{VARIABLE}={wanted}: {error}; expected a level, or levels of modules, as in coact_control=debug,info"
            );
        }
    }
}

/// What the variable asks for; warnings when it is empty.
fn filter(wanted: &str) -> Result<Targets, String> {
    match wanted.trim() {
        "" => Ok(Targets::new().with_default(LevelFilter::WARN)),
        wanted => wanted.parse().map_err(|error: tracing_subscriber::filter::ParseError| error.to_string()),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use tracing::Level;

    fn enabled(wanted: &str, target: &str, level: Level) -> bool {
        filter(wanted).unwrap().would_enable(target, &level)
    }

    #[test]
    fn warnings_are_logged_unless_something_else_is_asked_for() {
        assert!(enabled("", "coact_world", Level::WARN) && !enabled("", "coact_world", Level::INFO));
        assert!(enabled("debug", "coact_world", Level::DEBUG));
        let modules = "coact_world=trace,error";
        assert!(enabled(modules, "coact_world::person", Level::TRACE));
        assert!(!enabled(modules, "coact_control", Level::WARN));
        assert!(filter("coact_world=loud").is_err());
    }
}
