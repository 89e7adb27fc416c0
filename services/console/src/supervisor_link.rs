use crate::{Request, Ticket};
use coact_joint_task::Task;
use coact_pipeline::{Layout, Run};
use coact_run_records::NextRound;
use coact_supervisor::{StopRequest, request_fault, request_stop};
use rustix::process::{Pid, Signal, kill_process};
use std::path::{Path, PathBuf};

/// Carries out what an operator at a page asks of the run's supervisor.
#[derive(Debug)]
pub struct SupervisorLink {
    run: Run,
    /// Whether a page may be the partner.
    pub(crate) lets_play: bool,
    /// Where the console is.
    ticket: Ticket,
}

impl SupervisorLink {
    /// Of this run, whose partner may be a page, and whose console is there.
    pub fn new(run: Run, lets_play: bool, ticket: Ticket) -> Self {
        Self { run, lets_play, ticket }
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
            Request::Again { task, layout } => self.begin_again(task, *layout),
            _ => Ok(()),
        }
    }

    /// Has another run follow this one, with the task of that name, its parts laid out so.
    fn begin_again(&self, task: &str, layout: Layout) -> Result<(), String> {
        let settings = self.run.settings();
        let found = tasks(&settings.task).into_iter().find(|(name, _)| name == task);
        let (_, task) = found.ok_or_else(|| format!("there is no task {task}"))?;
        let next = NextRound { task, layout, port: self.ticket.port, token: self.ticket.token.clone() };
        next.leave(&settings.report).map_err(|error| error.to_string())?;
        self.end()
    }

    /// As Ctrl-C at the supervisor's terminal.
    fn end(&self) -> Result<(), String> {
        let owner = self.run.owner().map_err(|error| error.to_string())?;
        let pid =
            i32::try_from(owner.pid).ok().and_then(Pid::from_raw).ok_or("the supervisor has no process")?;
        kill_process(pid, Signal::INT).map_err(|error| error.to_string())
    }
}

/// Names and files of the tasks beside a task, itself among them: those that can be played.
pub(crate) fn tasks(beside: &Path) -> Vec<(String, PathBuf)> {
    let folder = beside.parent().and_then(|folder| std::fs::read_dir(folder).ok());
    let files = folder.into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path()));
    let tasks = files.filter_map(|path| {
        let is_toml = path.extension().is_some_and(|extension| extension == "toml");
        let task = is_toml.then(|| Task::load(&path).ok()).flatten()?;
        let has_hand = !task.grips.is_empty() && !task.subgoals.is_empty();
        has_hand.then(|| (path.file_stem().unwrap_or_default().to_string_lossy().into_owned(), path))
    });
    let mut tasks: Vec<_> = tasks.collect();
    tasks.sort();
    tasks
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn tasks_that_can_be_played_are_those_beside_the_present_one() {
        let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        let names: Vec<String> = tasks(&shipped).into_iter().map(|(name, _)| name).collect();
        assert!(names.contains(&"toy-vehicle".to_owned()) && names.contains(&"electronics-box".to_owned()));
        assert!(tasks(Path::new("/nowhere/a.toml")).is_empty());
    }
}
