//! What is asked of a running set, as its socket carries it: one line of JSON, and one line that answers.

use crate::operator_stop::StopRequest;
use coact_pipeline::Run;
use std::io::{self, BufRead, BufReader, Write};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Neither side waits longer than this for the other's line. The supervisor answers within some milliseconds: after this
/// time it has ended, or hangs. Chosen by hand.
pub(crate) const ANSWER_TIMEOUT: Duration = Duration::from_secs(2);

/// A request to a running set.
#[derive(Debug, serde::Serialize, serde::Deserialize)]
#[serde(tag = "request", rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum RequestLine {
    Inject { process: String, fault: String },
    Stop,
    Resume,
}

/// `refused` is absent when it was done, or need not be done; `unchanged` says why it need not.
#[derive(Debug, Default, serde::Serialize, serde::Deserialize)]
pub(crate) struct AnswerLine {
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub(crate) refused: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub(crate) unchanged: Option<String>,
}

/// Why a running set did not do what was asked of it.
#[derive(Debug, thiserror::Error)]
pub enum RequestError {
    /// The set cannot be reached. The message contains the cause, so that it is no source as well.
    #[error("{}: {cause}; expected a running set (coact launch) that listens there", path.display())]
    Unreachable {
        /// Its socket.
        path: PathBuf,
        /// Why.
        cause: io::Error,
    },
    /// It refused.
    #[error("{0}")]
    Refused(String),
}

/// Where the set listens.
pub(crate) fn socket_of(run: &Run) -> PathBuf {
    run.directory().join("control.sock")
}

/// Requests that a running set injects a fault into one of its processes now.
///
/// # Errors
/// [`RequestError`]: nothing listens there, or it knows no such process or fault.
pub fn request_fault(run: &Run, process: &str, fault: &str) -> Result<(), RequestError> {
    request(run, &RequestLine::Inject { process: process.into(), fault: fault.into() }).map(drop)
}

/// Requests that the robot of a running set stops, or may go on. Returns, in words, why that changed nothing, if it did not.
///
/// # Errors
/// [`RequestError`]: nothing listens there, or the run is ending.
pub fn request_stop(run: &Run, wanted: StopRequest) -> Result<Option<String>, RequestError> {
    let line = match wanted {
        StopRequest::Stop => RequestLine::Stop,
        StopRequest::Resume => RequestLine::Resume,
    };
    request(run, &line)
}

fn request(run: &Run, request: &RequestLine) -> Result<Option<String>, RequestError> {
    let path = socket_of(run);
    match exchange(&path, request) {
        Ok(AnswerLine { refused: None, unchanged }) => Ok(unchanged),
        Ok(AnswerLine { refused: Some(why), .. }) => Err(RequestError::Refused(why)),
        Err(cause) => Err(RequestError::Unreachable { path, cause }),
    }
}

fn exchange(path: &Path, request: &RequestLine) -> io::Result<AnswerLine> {
    let mut stream = UnixStream::connect(path)?;
    stream.set_read_timeout(Some(2 * ANSWER_TIMEOUT))?;
    writeln!(stream, "{}", serde_json::to_string(request)?)?;
    let mut line = String::new();
    BufReader::new(stream).read_line(&mut line)?;
    Ok(serde_json::from_str(&line)?)
}
