/// What a process set asks of the machine.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Demand {
    /// Cores that its real-time processes are pinned to.
    pub cores: Vec<usize>,
    /// Highest SCHED_FIFO priority of them.
    pub priority: u8,
}
