/// Why a movement of a hand is not used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum LeftOut {
    /// A body was lost in it, just before it or just after it, or jumped: its markers were mistaken for others.
    Lost,
    /// It led less far than 0.15 m, or took less than 0.3 s: its course says little beside the sway of the body.
    Short,
    /// Its path is longer than one and a half times the distance, or it leads back beyond one of its ends.
    Detour,
    /// It was faster than 1.2 m/s or took longer than 3 s: strokes of a tool that was handed over; standing about.
    NoTransport,
    /// It led nearly straight up or down, so that *aside* and *up* of its line mean nothing.
    Steep,
}

impl LeftOut {
    /// All reasons.
    pub const ALL: [Self; 5] = [Self::Lost, Self::Short, Self::Detour, Self::NoTransport, Self::Steep];

    /// As it is told.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lost => "with lost frames",
            Self::Short => "too short",
            Self::Detour => "detours",
            Self::NoTransport => "too fast or too slow",
            Self::Steep => "straight up or down",
        }
    }
}
