use crate::{Fault, UnknownFault};
use std::str::FromStr;
use std::time::Duration;

/// A fault that is due at a time, as in `fields:kill@20s`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Injection {
    /// Name of the process.
    pub process: String,
    /// What is done to it.
    pub fault: Fault,
    /// When, counted from tick 0.
    pub at: Duration,
}

/// Why an injection could not be read.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub enum InjectionError {
    /// Not of the form `PROCESS:FAULT@TIME`.
    #[error("'{0}': expected PROCESS:FAULT@TIME, for example fields:kill@20s")]
    Form(String),
    /// No such fault.
    #[error("'{spec}': {cause}")]
    Fault {
        /// The whole text.
        spec: String,
        /// What is wrong with it.
        cause: UnknownFault,
    },
    /// Not a time.
    #[error(
        "'{spec}': '{time}' is not a time; expected seconds or milliseconds, for example 20s, 1.5s or 500ms"
    )]
    Time {
        /// The whole text.
        spec: String,
        /// The part that should be a time.
        time: String,
    },
}

impl FromStr for Injection {
    type Err = InjectionError;

    fn from_str(spec: &str) -> Result<Self, InjectionError> {
        let form = || InjectionError::Form(spec.into());
        let (process, rest) = spec.split_once(':').ok_or_else(form)?;
        let (fault, time) = rest.split_once('@').ok_or_else(form)?;
        if process.is_empty() {
            return Err(form());
        }
        let fault = fault.parse().map_err(|cause| InjectionError::Fault { spec: spec.into(), cause })?;
        let at =
            read_time(time).ok_or_else(|| InjectionError::Time { spec: spec.into(), time: time.into() })?;
        Ok(Self { process: process.into(), fault, at })
    }
}

const SECONDS_PER_MILLISECOND: f64 = 1e-3;

/// Seconds (`20s`, `1.5s`) or milliseconds (`500ms`).
fn read_time(text: &str) -> Option<Duration> {
    let (number, unit) = match text.strip_suffix("ms") {
        Some(number) => (number, SECONDS_PER_MILLISECOND),
        None => (text.strip_suffix('s')?, 1.0),
    };
    Duration::try_from_secs_f64(number.parse::<f64>().ok()? * unit).ok()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn refused(spec: &str) -> String {
        spec.parse::<Injection>().unwrap_err().to_string()
    }

    #[test]
    fn process_fault_and_time_are_read() {
        let expected =
            Injection { process: "fields".into(), fault: Fault::Kill, at: Duration::from_secs(20) };
        assert_eq!("fields:kill@20s".parse(), Ok(expected));
        let later: Injection = "world:crash-on-start@1500ms".parse().unwrap();
        assert_eq!((later.fault, later.at), (Fault::CrashOnStart, Duration::from_millis(1500)));
    }

    #[test]
    fn what_is_wrong_is_named() {
        assert!(refused("fields").contains("PROCESS:FAULT@TIME"));
        assert!(refused("fields:kill").contains("PROCESS:FAULT@TIME"));
        assert!(refused(":kill@1s").contains("PROCESS:FAULT@TIME"));
        assert!(refused("fields:melt@1s").contains("'melt'"));
        for time in ["20", "s", "-1s", "soon", "NaNs", "infs", "1h"] {
            assert!(refused(&format!("fields:kill@{time}")).contains(&format!("'{time}' is not a time")));
        }
    }
}
