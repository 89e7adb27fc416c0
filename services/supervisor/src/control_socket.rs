use crate::{Fault, InjectionRefusal, operator};
use coact_pipeline::Run;
use std::fs::Permissions;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::os::unix::fs::PermissionsExt;
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, mpsc};
use std::time::Duration;

/// Where a running set listens for faults to inject: `control.sock` in the run directory. A request is one line of JSON
/// ([`RequestLine`]), and so is its answer ([`AnswerLine`]).
#[derive(Debug)]
pub(crate) struct ControlSocket {
    path: PathBuf,
    requests: mpsc::Receiver<FaultRequest>,
    closed: Arc<AtomicBool>,
}

/// A request to inject a fault now.
#[derive(Debug)]
pub(crate) struct FaultRequest {
    pub(crate) process: String,
    pub(crate) fault: Fault,
    answer: mpsc::Sender<AnswerLine>,
}

#[derive(Debug, serde::Serialize, serde::Deserialize)]
struct RequestLine {
    process: String,
    fault: String,
}

/// `refused` is absent when the fault was injected.
#[derive(Debug, Default, serde::Serialize, serde::Deserialize)]
struct AnswerLine {
    #[serde(skip_serializing_if = "Option::is_none", default)]
    refused: Option<String>,
}

/// Why a running set injected nothing.
#[derive(Debug, thiserror::Error)]
pub enum FaultRequestError {
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

/// Neither side waits longer than this for the other's line. The supervisor answers within some milliseconds: after this
/// time it has ended, or hangs. Chosen by hand.
const ANSWER_TIMEOUT: Duration = Duration::from_secs(2);
/// No request is longer than this, bytes: far more than two names take.
const MAX_REQUEST: u64 = 4096;

fn path_of(run: &Run) -> PathBuf {
    run.directory().join("control.sock")
}

/// Requests that a running set injects a fault into one of its processes now.
///
/// # Errors
/// [`FaultRequestError`]: nothing listens there, or it knows no such process or fault.
pub fn request_fault(run: &Run, process: &str, fault: &str) -> Result<(), FaultRequestError> {
    let path = path_of(run);
    let request = RequestLine { process: process.into(), fault: fault.into() };
    match exchange(&path, &request) {
        Ok(AnswerLine { refused: None }) => Ok(()),
        Ok(AnswerLine { refused: Some(why) }) => Err(FaultRequestError::Refused(why)),
        Err(cause) => Err(FaultRequestError::Unreachable { path, cause }),
    }
}

fn exchange(path: &std::path::Path, request: &RequestLine) -> io::Result<AnswerLine> {
    let mut stream = UnixStream::connect(path)?;
    stream.set_read_timeout(Some(2 * ANSWER_TIMEOUT))?;
    writeln!(stream, "{}", serde_json::to_string(request)?)?;
    let mut line = String::new();
    BufReader::new(stream).read_line(&mut line)?;
    Ok(serde_json::from_str(&line)?)
}

impl ControlSocket {
    /// Listens on a thread of its own: no client can delay the supervision.
    ///
    /// # Errors
    /// The socket cannot be made.
    pub(crate) fn open(run: &Run) -> io::Result<Self> {
        let path = path_of(run);
        let listener = UnixListener::bind(&path)?;
        std::fs::set_permissions(&path, Permissions::from_mode(0o600))?;
        let (sender, requests) = mpsc::channel();
        let closed = Arc::new(AtomicBool::new(false));
        let over = Arc::clone(&closed);
        std::thread::spawn(move || {
            for stream in listener.incoming() {
                if over.load(Ordering::Relaxed) {
                    return;
                }
                // A client that breaks the protocol or goes away gets no answer, and concerns nobody else.
                stream.and_then(|stream| serve(stream, &sender)).ok();
            }
        });
        Ok(Self { path, requests, closed })
    }

    /// The next request that has come.
    pub(crate) fn next(&self) -> Option<FaultRequest> {
        self.requests.try_recv().ok()
    }
}

impl Drop for ControlSocket {
    fn drop(&mut self) {
        self.closed.store(true, Ordering::Relaxed);
        // Wakes the listening thread.
        UnixStream::connect(&self.path).ok();
    }
}

impl FaultRequest {
    /// Sends the answer.
    pub(crate) fn answer(self, outcome: Result<(), InjectionRefusal>) {
        let refused = outcome.err().map(|refusal| refusal.to_string());
        self.answer.send(AnswerLine { refused }).ok();
    }
}

fn serve(mut stream: UnixStream, requests: &mpsc::Sender<FaultRequest>) -> io::Result<()> {
    stream.set_read_timeout(Some(ANSWER_TIMEOUT))?;
    stream.set_write_timeout(Some(ANSWER_TIMEOUT))?;
    let mut line = String::new();
    BufReader::new((&stream).take(MAX_REQUEST)).read_line(&mut line)?;
    let answer = operator::check(&stream)?
        .and_then(|()| forward(&line, requests))
        .unwrap_or_else(|why| AnswerLine { refused: Some(why) });
    writeln!(stream, "{}", serde_json::to_string(&answer)?)
}

/// What a line that came on the socket asks for: a process, and the fault to be injected into it.
///
/// # Errors
/// Why it is no request, in words for who sent it.
pub fn read_request(line: &str) -> Result<(String, Fault), String> {
    let line: RequestLine = serde_json::from_str(line)
        .map_err(|error| format!("{error}; expected {{\"process\": \"...\", \"fault\": \"...\"}}"))?;
    let fault = line.fault.parse::<Fault>().map_err(|error| error.to_string())?;
    Ok((line.process, fault))
}

fn forward(line: &str, requests: &mpsc::Sender<FaultRequest>) -> Result<AnswerLine, String> {
    let (process, fault) = read_request(line)?;
    let (answer, answered) = mpsc::channel();
    let over = |_| "the run is ending".to_owned();
    requests.send(FaultRequest { process, fault, answer }).map_err(|error| over(error.to_string()))?;
    answered.recv_timeout(ANSWER_TIMEOUT).map_err(|error| over(error.to_string()))
}
