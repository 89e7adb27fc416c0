use crate::Request;
use coact_pipeline::Run;
use coact_supervisor::{StopRequest, request_fault, request_stop};
use rustix::process::{Pid, Signal, kill_process};

/// Carries out what an operator at a page asks of the run's supervisor.
#[derive(Debug)]
pub struct SupervisorLink {
    run: Run,
    /// Whether a page may be the partner.
    pub(crate) lets_play: bool,
}

impl SupervisorLink {
    /// Of this run, whose partner may be a page.
    pub fn new(run: Run, lets_play: bool) -> Self {
        Self { run, lets_play }
    }

    /// Asks the supervisor, and waits for its answer.
    ///
    /// # Errors
    /// Why it was refused.
    pub(crate) fn carry_out(&self, request: &Request) -> Result<(), String> {
        let refused = |error: coact_supervisor::RequestError| error.to_string();
        match request {
            Request::Inject { process, fault } => request_fault(&self.run, process, fault).map_err(refused),
            Request::Stop(_) => request_stop(&self.run, StopRequest::Stop).map(drop).map_err(refused),
            Request::Resume(_) => request_stop(&self.run, StopRequest::Resume).map(drop).map_err(refused),
            Request::End(_) => self.end(),
            _ => Ok(()),
        }
    }

    /// As Ctrl-C at the supervisor's terminal.
    fn end(&self) -> Result<(), String> {
        let owner = self.run.owner().map_err(|error| error.to_string())?;
        let pid =
            i32::try_from(owner.pid).ok().and_then(Pid::from_raw).ok_or("the supervisor has no process")?;
        kill_process(pid, Signal::INT).map_err(|error| error.to_string())
    }
}
