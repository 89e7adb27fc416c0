/// Why a reader ignores a message, in the order in which it looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(usize)]
pub enum Refusal {
    /// Its layout is another one than [`LAYOUT`](crate::LAYOUT).
    Layout = 0,
    /// It is stamped later than now, or its cycle is more than one ahead of the present one.
    Future = 1,
    /// Its cycle is longer ago than messages of its topic matter.
    Stale = 2,
    /// Its sender is not the process that writes the topic, or not the only one that says so.
    Writer = 3,
    /// Its sender has been replaced.
    Generation = 4,
    /// Its sequence is not beyond that of the message before: it is repeated.
    Repeated = 5,
    /// Its cycle is before that of the message before.
    Backward = 6,
    /// A field is not what it can be; see [`Plausible`](crate::Plausible).
    Implausible = 7,
    /// There are more messages than anybody says.
    TooOften = 8,
    /// Its sender's memory cannot be read.
    Unreadable = 9,
}

impl Refusal {
    /// How many reasons there are.
    pub const COUNT: usize = 10;

    /// All reasons, in the order of their numbers.
    pub const ALL: [Self; Self::COUNT] = [
        Self::Layout,
        Self::Future,
        Self::Stale,
        Self::Writer,
        Self::Generation,
        Self::Repeated,
        Self::Backward,
        Self::Implausible,
        Self::TooOften,
        Self::Unreadable,
    ];

    /// The reason in a word or two, as reports write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Layout => "other layout",
            Self::Future => "from the future",
            Self::Stale => "too old",
            Self::Writer => "unknown writer",
            Self::Generation => "replaced writer",
            Self::Repeated => "repeated",
            Self::Backward => "backward",
            Self::Implausible => "implausible",
            Self::TooOften => "too often",
            Self::Unreadable => "unreadable",
        }
    }
}
