use crate::{FaultKind, Moment, Target};
use coact_supervisor::Fault;
use serde::Serialize;
use std::fmt;

/// One cell of the matrix: what happens, to whom, and when.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize)]
pub struct Cell {
    /// What happens.
    pub fault: FaultKind,
    /// To whom.
    pub target: Target,
    /// When.
    pub moment: Moment,
}

impl Cell {
    /// Whether the run ends by it, or consists of it: it cannot share a run.
    pub(crate) fn needs_own_run(&self) -> bool {
        matches!(self.moment, Moment::StartUp | Moment::Shutdown)
            || self.fault.ends_the_set()
            || self.fault.fills()
            || self.fault == FaultKind::Adoption
            || self.kills_supervisor()
    }

    /// Who dies while the supervisor gets no file handles.
    pub(crate) const WHILE_STARVED: &str = "perception";

    /// The processes to which something is done.
    pub(crate) fn struck(&self) -> Vec<&'static str> {
        let starves_supervisor =
            self.target == Target::Supervisor && self.fault == FaultKind::Process(Fault::NoHandles);
        if starves_supervisor { vec![Self::WHILE_STARVED] } else { self.target.processes() }
    }

    pub(crate) fn kills_supervisor(&self) -> bool {
        self.target == Target::Supervisor && self.fault.is_lethal()
    }
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}@{}", self.target, self.fault, self.moment)
    }
}
