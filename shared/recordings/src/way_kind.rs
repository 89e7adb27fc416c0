/// What a hand does along its way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum WayKind {
    /// Carries something to where it is put, or has it with it.
    Carry,
    /// Holds something out for another to take.
    Give,
    /// Draws back, empty, from what it has put down or given.
    Withdraw,
}

impl WayKind {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Carry, Self::Give, Self::Withdraw];

    /// As the file of ways names it: `carry`, `give`, `withdraw`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Carry => "carry",
            Self::Give => "give",
            Self::Withdraw => "withdraw",
        }
    }
}
