/// Page faults of one thread since it began.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ThreadFaults {
    /// Those for which a page was found in memory.
    pub minor: u64,
    /// Those for which a disk was read.
    pub major: u64,
}

impl ThreadFaults {
    /// Of a process's first thread. Only to be asked while the set surely lives: the kernel holds a process whose entries are
    /// read, and a supervisor of a real-time class that reaps it meanwhile would spin on the reader's core.
    ///
    /// None for a process that does not live.
    pub fn of(pid: u32) -> Option<Self> {
        let text = std::fs::read_to_string(format!("/proc/{pid}/task/{pid}/stat")).ok()?;
        // The name before the last bracket may hold anything.
        let mut fields = text.rsplit_once(')')?.1.split_ascii_whitespace();
        let minor = fields.nth(MINOR - 1)?.parse().ok()?;
        let major = fields.nth(MAJOR - MINOR - 1)?.parse().ok()?;
        Some(Self { minor, major })
    }

    /// How many there were since `before`.
    #[must_use]
    pub fn since(self, before: Self) -> Self {
        Self { minor: self.minor - before.minor, major: self.major - before.major }
    }
}

/// Place of `minflt` behind the name: proc_pid_stat(5) counts it 10, the name 2.
const MINOR: usize = 8;
/// Place of `majflt`.
const MAJOR: usize = 10;
