/// What else the machine has to do meanwhile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Load {
    None,
    Cpu,
    Memory,
    Io,
    All,
}

impl Load {
    /// Every load.
    pub const ALL: [Self; 5] = [Self::None, Self::Cpu, Self::Memory, Self::Io, Self::All];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Cpu => "cpu",
            Self::Memory => "memory",
            Self::Io => "io",
            Self::All => "all",
        }
    }

    /// What stress-ng is told, if it is needed: one worker of each kind on each core (0 means that), and no more memory or disk than
    /// a small machine has. Chosen by hand.
    pub fn arguments(self) -> Option<Vec<&'static str>> {
        let cpu = ["--cpu", "0"].as_slice();
        let memory = ["--vm", "0", "--vm-bytes", "256M", "--cache", "0"].as_slice();
        let io = ["--hdd", "1", "--hdd-bytes", "64M", "--sock", "1", "--timer", "1"].as_slice();
        let kinds = match self {
            Self::None => return None,
            Self::Cpu => vec![cpu],
            Self::Memory => vec![memory],
            Self::Io => vec![io],
            Self::All => vec![cpu, memory, io],
        };
        Some(kinds.concat())
    }
}

impl std::str::FromStr for Load {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let names = Self::ALL.map(Self::name);
        let found = Self::ALL.into_iter().find(|load| load.name() == text);
        found.ok_or_else(|| format!("expected one of {}", names.join(", ")))
    }
}

impl std::fmt::Display for Load {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(self.name())
    }
}
