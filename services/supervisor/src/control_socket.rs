use crate::operator::Operator;
use crate::set_request::{ANSWER_TIMEOUT, AnswerLine, RequestLine, socket_of};
use crate::{Fault, InjectionRefusal, StopRequest};
use coact_pipeline::Run;
use std::fs::Permissions;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::os::unix::fs::PermissionsExt;
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, mpsc};

/// Where a running set listens for what its operator wants: `control.sock` in the run directory.
#[derive(Debug)]
pub(crate) struct ControlSocket {
    path: PathBuf,
    requests: mpsc::Receiver<SetRequest>,
    closed: Arc<AtomicBool>,
}

/// What an operator wants of the set now.
#[derive(Debug)]
pub(crate) struct SetRequest {
    pub(crate) operator: Operator,
    pub(crate) wanted: Wanted,
    pub(crate) asker: Asker,
}

/// Who waits for the answer to a request.
#[derive(Debug)]
pub(crate) struct Asker(mpsc::Sender<AnswerLine>);

/// What is asked of a running set.
#[derive(Debug)]
pub enum Wanted {
    /// That a fault be injected.
    Fault {
        /// Into this process.
        process: String,
        /// The fault.
        fault: Fault,
    },
    /// That the robot stop, or go on.
    Stop(StopRequest),
}

/// No request is longer than this, bytes: far more than two names take.
const MAX_REQUEST: u64 = 4096;

impl ControlSocket {
    /// Listens on a thread of its own: no client can delay the supervision. Each client has a thread as well: none that says
    /// nothing can delay a stop.
    ///
    /// # Errors
    /// The socket cannot be made.
    pub(crate) fn open(run: &Run) -> io::Result<Self> {
        let path = socket_of(run);
        // A supervisor that was killed has left its own.
        std::fs::remove_file(&path).ok();
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
                let Ok(stream) = stream else { continue };
                let sender = sender.clone();
                // A client that breaks the protocol or goes away gets no answer, and concerns nobody else.
                let served = std::thread::Builder::new().spawn(move || serve(stream, &sender).ok());
                if let Err(error) = served {
                    tracing::warn!("an operator's request was not heard: {error}");
                }
            }
        });
        Ok(Self { path, requests, closed })
    }

    /// The next request that has come.
    pub(crate) fn next(&self) -> Option<SetRequest> {
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

impl Asker {
    /// Whether a fault was injected.
    pub(crate) fn injected(self, outcome: Result<(), InjectionRefusal>) {
        let refused = outcome.err().map(|refusal| refusal.to_string());
        self.0.send(AnswerLine { refused, ..AnswerLine::default() }).ok();
    }

    /// That the latch is as was wanted; in words why that was no change, if it was none.
    pub(crate) fn latched(self, unchanged: Option<String>) {
        self.0.send(AnswerLine { unchanged, ..AnswerLine::default() }).ok();
    }
}

fn serve(mut stream: UnixStream, requests: &mpsc::Sender<SetRequest>) -> io::Result<()> {
    stream.set_read_timeout(Some(ANSWER_TIMEOUT))?;
    stream.set_write_timeout(Some(ANSWER_TIMEOUT))?;
    let operator = Operator::of(&stream)?;
    let mut line = String::new();
    BufReader::new((&stream).take(MAX_REQUEST)).read_line(&mut line)?;
    let answer = operator
        .check()
        .and_then(|()| forward(&line, operator, requests))
        .unwrap_or_else(|why| AnswerLine { refused: Some(why), ..AnswerLine::default() });
    writeln!(stream, "{}", serde_json::to_string(&answer)?)
}

fn forward(
    line: &str,
    operator: Operator,
    requests: &mpsc::Sender<SetRequest>,
) -> Result<AnswerLine, String> {
    let wanted = read_request(line)?;
    let (answer, answered) = mpsc::channel();
    let over = |_| "the run is ending".to_owned();
    let request = SetRequest { operator, wanted, asker: Asker(answer) };
    requests.send(request).map_err(|error| over(error.to_string()))?;
    answered.recv_timeout(ANSWER_TIMEOUT).map_err(|error| over(error.to_string()))
}

/// What a line that came on the socket asks for.
///
/// # Errors
/// Why it is no request, in words for who sent it.
pub fn read_request(line: &str) -> Result<Wanted, String> {
    let expected = "expected {\"request\": \"inject\", \"process\": \"...\", \"fault\": \"...\"}, {\"request\": \"stop\"} \
                    or {\"request\": \"resume\"}";
    match serde_json::from_str(line).map_err(|error| format!("{error}; {expected}"))? {
        RequestLine::Inject { process, fault } => {
            let fault = fault.parse::<Fault>().map_err(|error| error.to_string())?;
            Ok(Wanted::Fault { process, fault })
        }
        RequestLine::Stop => Ok(Wanted::Stop(StopRequest::Stop)),
        RequestLine::Resume => Ok(Wanted::Stop(StopRequest::Resume)),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn requests_are_read_and_what_is_none_is_told_what_would_be() {
        assert!(matches!(read_request("{\"request\": \"stop\"}\n"), Ok(Wanted::Stop(StopRequest::Stop))));
        assert!(matches!(read_request("{\"request\": \"resume\"}\n"), Ok(Wanted::Stop(StopRequest::Resume))));
        let fault = read_request("{\"request\": \"inject\", \"process\": \"fields\", \"fault\": \"kill\"}");
        assert!(matches!(fault, Ok(Wanted::Fault { process, fault: Fault::Kill }) if process == "fields"));
        for line in
            ["", "stop", "{\"request\": \"halt\"}", "{\"request\": \"inject\", \"process\": \"fields\"}"]
        {
            assert!(read_request(line).unwrap_err().contains("expected {\"request\""), "{line}");
        }
    }
}
