use crate::MessageFault;
use coact_supervisor::Fault;
use serde::{Serialize, Serializer};
use std::fmt;
use std::time::Duration;

/// What happens in a cell of the matrix.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FaultKind {
    /// Nothing: what is broken here already, no fault has broken.
    Nothing,
    /// Something is done to a process.
    Process(Fault),
    /// A stranger sends on the topic of a process what is not good.
    Message(MessageFault),
    /// Viewers take every place on the topics of the chain, and a process is killed meanwhile.
    ViewerFlood,
    /// No shared memory is left, and a process is killed meanwhile.
    MemoryFull,
    /// No room is left for the report, for a while.
    ReportFull,
    /// Another set is started on the same machine.
    SecondSet,
    /// The supervisor is killed, and a successor adopts the set.
    Adoption,
    /// Somebody puts the description of a living run where dead ones are found and removed.
    PlantedRun,
}

impl FaultKind {
    /// Whether the process ends by it, and not because somebody finds it hung.
    pub(crate) fn is_lethal(self) -> bool {
        match self {
            _ if self.keeps_output() => false,
            Self::Process(fault) => !matches!(
                fault,
                Fault::Stop
                    | Fault::StopShort
                    | Fault::StopForGood
                    | Fault::Block
                    | Fault::SlowByHalf
                    | Fault::Slow
                    | Fault::SlowByFive
                    | Fault::FreezePlanner
            ),
            Self::ViewerFlood | Self::MemoryFull => true,
            Self::Nothing | Self::Message(_) | Self::ReportFull | Self::SecondSet => false,
            Self::Adoption | Self::PlantedRun => false,
        }
    }

    /// Whether a process may live through it: a short pause, or slowness.
    pub(crate) fn may_be_survived(self) -> bool {
        matches!(
            self,
            Self::Process(Fault::StopShort | Fault::SlowByHalf | Fault::Slow | Fault::SlowByFive)
                | Self::Nothing
                | Self::Message(_)
                | Self::ReportFull
                | Self::SecondSet
                | Self::Adoption
                | Self::PlantedRun
        ) || self.keeps_output()
    }

    /// Whether it fills a file system: then the run gets one of its own.
    pub(crate) fn fills(self) -> bool {
        matches!(self, Self::MemoryFull | Self::ReportFull)
    }

    /// Whether what the process remembered is spoiled: it is to begin anew, and not with that.
    pub(crate) fn spoils_state(self) -> bool {
        self == Self::Process(Fault::PoisonedResume)
    }

    /// Whether the process goes on with its cycles, so that no outage tells of it.
    pub(crate) fn keeps_output(self) -> bool {
        self == Self::Process(Fault::NoHandles) || !self.lasts().is_zero()
    }

    /// How long it goes on.
    pub(crate) fn lasts(self) -> Duration {
        match self {
            Self::Process(fault) => fault.drop_out().unwrap_or_default(),
            _ => Duration::ZERO,
        }
    }

    /// So many starts of a process it takes until one lives.
    pub(crate) fn restarts(self) -> usize {
        match self {
            Self::Process(Fault::CrashOnStart | Fault::StuckOnStart) => 2,
            Self::Process(Fault::StopShort | Fault::Slow | Fault::SlowByFive | Fault::NoHandles) => 1,
            kind if kind.may_be_survived() => 0,
            _ => 1,
        }
    }

    /// Whether the set is to be given up after it.
    pub(crate) fn ends_the_set(self) -> bool {
        self == Self::Process(Fault::CrashLoop)
    }
}

impl fmt::Display for FaultKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Nothing => "nothing",
            Self::Process(fault) => fault.name(),
            Self::Message(fault) => fault.name(),
            Self::ViewerFlood => "viewer-flood",
            Self::MemoryFull => "memory-full",
            Self::ReportFull => "report-full",
            Self::SecondSet => "second-set",
            Self::Adoption => "adoption",
            Self::PlantedRun => "planted-run",
        })
    }
}

impl Serialize for FaultKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
