use crate::{Fault, Refusal};
use coact_pipeline::Run;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, mpsc};
use std::time::Duration;

/// Where a running set listens for faults to inject: `control.sock` in the run directory. One line of JSON asks
/// ([`Asked`]), one line answers ([`Answer`]).
#[derive(Debug)]
pub(crate) struct ControlSocket {
    path: PathBuf,
    requests: mpsc::Receiver<Request>,
    closed: Arc<AtomicBool>,
}

/// A fault that somebody wants to have injected now.
#[derive(Debug)]
pub(crate) struct Request {
    pub(crate) process: String,
    pub(crate) fault: Fault,
    answer: mpsc::Sender<Answer>,
}

#[derive(Debug, serde::Serialize, serde::Deserialize)]
struct Asked {
    process: String,
    fault: String,
}

/// `refused` is absent when the fault was injected.
#[derive(Debug, Default, serde::Serialize, serde::Deserialize)]
struct Answer {
    #[serde(skip_serializing_if = "Option::is_none", default)]
    refused: Option<String>,
}

/// Why a running set injected nothing.
#[derive(Debug, thiserror::Error)]
pub enum AskError {
    /// The set cannot be reached.
    #[error("{}: {source}; expected a running set (coact launch) that listens there", path.display())]
    Unreachable {
        /// Its socket.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// It refused.
    #[error("{0}")]
    Refused(String),
}

/// Neither side waits longer than this for the other's line.
const PATIENCE: Duration = Duration::from_secs(2);
/// No request is longer than this, bytes.
const LONGEST: u64 = 4096;

fn path_of(run: &Run) -> PathBuf {
    run.directory().join("control.sock")
}

/// Asks a running set to inject a fault into one of its processes now.
///
/// # Errors
/// [`AskError`]: nothing listens there, or it knows no such process or fault.
pub fn ask_for_fault(run: &Run, process: &str, fault: &str) -> Result<(), AskError> {
    let path = path_of(run);
    let asked = Asked { process: process.into(), fault: fault.into() };
    match exchange(&path, &asked) {
        Ok(Answer { refused: None }) => Ok(()),
        Ok(Answer { refused: Some(why) }) => Err(AskError::Refused(why)),
        Err(source) => Err(AskError::Unreachable { path, source }),
    }
}

fn exchange(path: &std::path::Path, asked: &Asked) -> io::Result<Answer> {
    let mut stream = UnixStream::connect(path)?;
    stream.set_read_timeout(Some(2 * PATIENCE))?;
    writeln!(stream, "{}", serde_json::to_string(asked)?)?;
    let mut line = String::new();
    BufReader::new(stream).read_line(&mut line)?;
    Ok(serde_json::from_str(&line)?)
}

impl ControlSocket {
    /// Listens on a thread of its own: nobody who asks can hold up the supervision.
    ///
    /// # Errors
    /// The socket cannot be made.
    pub(crate) fn open(run: &Run) -> io::Result<Self> {
        let path = path_of(run);
        let listener = UnixListener::bind(&path)?;
        let (sender, requests) = mpsc::channel();
        let closed = Arc::new(AtomicBool::new(false));
        let over = Arc::clone(&closed);
        std::thread::spawn(move || {
            for stream in listener.incoming() {
                if over.load(Ordering::Relaxed) {
                    return;
                }
                // Who asks in the wrong way or goes away gets no answer; that is nobody else's trouble.
                stream.and_then(|stream| serve(stream, &sender)).ok();
            }
        });
        Ok(Self { path, requests, closed })
    }

    /// The next request that has come.
    pub(crate) fn next(&self) -> Option<Request> {
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

impl Request {
    /// Answers it.
    pub(crate) fn answer(self, outcome: Result<(), Refusal>) {
        let refused = outcome.err().map(|refusal| refusal.to_string());
        self.answer.send(Answer { refused }).ok();
    }
}

fn serve(mut stream: UnixStream, requests: &mpsc::Sender<Request>) -> io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let mut line = String::new();
    BufReader::new((&stream).take(LONGEST)).read_line(&mut line)?;
    let answer = pass_on(&line, requests).unwrap_or_else(|why| Answer { refused: Some(why) });
    writeln!(stream, "{}", serde_json::to_string(&answer)?)
}

fn pass_on(line: &str, requests: &mpsc::Sender<Request>) -> Result<Answer, String> {
    let asked: Asked = serde_json::from_str(line)
        .map_err(|error| format!("{error}; expected {{\"process\": \"...\", \"fault\": \"...\"}}"))?;
    let fault = asked.fault.parse::<Fault>().map_err(|error| error.to_string())?;
    let (answer, answered) = mpsc::channel();
    let over = |_| "the run is ending".to_owned();
    requests
        .send(Request { process: asked.process, fault, answer })
        .map_err(|error| over(error.to_string()))?;
    answered.recv_timeout(PATIENCE).map_err(|error| over(error.to_string()))
}
