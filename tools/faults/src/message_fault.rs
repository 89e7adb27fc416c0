use coact_messages::{Header, LAYOUT, Refusal};

/// So many cycles ago is too long ago for every topic of the chain (`TopicEntry::lifetime`).
const LONG_AGO: u64 = 6000;

/// What is wrong with a message that a stranger sends on a topic.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum MessageFault {
    /// Every bit is set.
    Garbage,
    /// The layout is another one.
    Layout,
    /// All numbers behind a good header are NaN.
    NotANumber,
    /// The cycle is long ago.
    Stale,
    /// The sequence has been used.
    Repeated,
    /// The cycle lies before the newest.
    Backward,
    /// The cycle is to come.
    Future,
}

impl MessageFault {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Garbage,
        Self::Layout,
        Self::NotANumber,
        Self::Stale,
        Self::Repeated,
        Self::Backward,
        Self::Future,
    ];

    /// The name that command line and reports use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Garbage => "garbage",
            Self::Layout => "wrong-layout",
            Self::NotANumber => "nan",
            Self::Stale => "stale",
            Self::Repeated => "repeated",
            Self::Backward => "backward",
            Self::Future => "future",
        }
    }

    /// For which reasons readers may ignore it. Of messages whose time is good, the sender is looked at first: it is a stranger,
    /// or, where the topic's writer has been replaced, looks like its predecessor.
    pub fn refusals(self) -> &'static [Refusal] {
        match self {
            Self::Garbage | Self::Layout => &[Refusal::Layout],
            Self::Stale => &[Refusal::Stale],
            Self::Future => &[Refusal::Future],
            Self::NotANumber | Self::Repeated | Self::Backward => &[Refusal::Writer, Refusal::Generation],
        }
    }

    /// From which cycle of a run on there can be such a message: what is stale is older than five seconds.
    pub(crate) fn possible_from(self) -> u64 {
        if self == Self::Stale { LONG_AGO } else { 0 }
    }

    /// The header of such a message in this cycle.
    pub(crate) fn header(self, tick: u64, now_ns: u64) -> Header {
        let good = Header {
            layout: LAYOUT,
            generation: 0,
            sequence: u64::from(u32::MAX),
            cycle: tick,
            sensor_ns: now_ns,
            published_ns: now_ns,
            reserved: 0,
        };
        match self {
            Self::Garbage => bytemuck::cast([0xff_u8; size_of::<Header>()]),
            Self::Layout => Header { layout: LAYOUT + 1, ..good },
            Self::NotANumber => good,
            Self::Stale => Header { cycle: tick.saturating_sub(LONG_AGO), ..good },
            Self::Repeated => Header { sequence: 1, ..good },
            Self::Backward => Header { cycle: tick.saturating_sub(10), ..good },
            Self::Future => Header { cycle: tick + 1500, ..good },
        }
    }

    /// What every byte behind the header is: words of ones are NaN.
    pub(crate) fn fill(self) -> u8 {
        match self {
            Self::Garbage | Self::NotANumber => 0xff,
            _ => 0,
        }
    }
}
