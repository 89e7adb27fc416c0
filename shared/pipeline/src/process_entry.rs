use std::time::Duration;

/// One process of the table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProcessEntry {
    /// Its name: what operators, reports and topics call it.
    pub name: String,
    /// The program that is started: a file beside the supervisor's own, or a path.
    pub program: String,
    /// Processes are started in ascending order, and stopped in descending order; equal ones together.
    pub order: u32,
    /// True if the task cannot go on without it: when the restart policy is exhausted, the run is given up. Another one is
    /// restarted for ever.
    pub needed: bool,
    /// True if it is started only in a run that asks for it by its name ([`RunSettings::requested`](crate::RunSettings)).
    pub on_request: bool,
    /// True if it is to run under SCHED_FIFO with locked memory.
    pub realtime: bool,
    /// SCHED_FIFO priority, 1 to 99; used when `realtime`.
    pub priority: u8,
    /// The process that it stands by for, if it is a standby: in each cycle in which that one sends nothing, it does.
    pub standby_of: Option<String>,
    /// True if the next one is started ahead: loaded, and out of the run until this one dies.
    pub spare: bool,
    /// Core to which it is pinned; any core when absent.
    pub core: Option<usize>,
    /// What starts its cycles.
    pub trigger: Trigger,
    /// Offset from the release at which a cycle starts although its trigger's message has not come; zero for the timer.
    pub latest_start: Duration,
    /// How long it may take from its start to its report of readiness.
    pub ready_within: Duration,
    /// How long it may take to stop after SIGTERM before it is killed.
    pub stop_grace: Duration,
}

impl ProcessEntry {
    /// Highest priority of SCHED_FIFO.
    pub const HIGHEST: u8 = 99;

    /// A standby of this process: the same program on the same core. The task goes on without it.
    ///
    /// Its priority is one above the process's: a process that is killed gives back its memory in its own priority, for
    /// milliseconds, and the standby has to get on meanwhile.
    pub(crate) fn standby(&self) -> Self {
        let name = format!("{}-standby", self.name);
        let priority = if self.realtime { (self.priority + 1).min(Self::HIGHEST) } else { self.priority };
        Self {
            name,
            standby_of: Some(self.name.clone()),
            needed: false,
            priority,
            spare: false,
            ..self.clone()
        }
    }
}

/// What starts the cycles of a process.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Trigger {
    /// The release of each period.
    Timer,
    /// Arrival of a message on this topic.
    Topic(String),
    /// Nothing: the process follows the run at its own pace (monitor, voice).
    None,
}
