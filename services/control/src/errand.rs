/// What the hand is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u64)]
pub(crate) enum Errand {
    /// Going to, or standing at, the park posture; a held part stays in the hand.
    Park = 0,
    /// Taking a part from the robot's workspace.
    Take = 1,
    /// Putting the held part into its socket.
    Place = 2,
    /// Putting the held part back on the table.
    PutBack = 3,
    /// Holding out the open hand.
    Ask = 4,
    /// Taking a part from the person's hand.
    Receive = 5,
    /// Holding out the held part until the person has it.
    Offer = 6,
    /// Steadying the base.
    Steady = 7,
    /// Pointing to a part.
    Point = 8,
}

/// One stretch of an errand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u64)]
pub(crate) enum Leg {
    /// Standing, ready for the next errand.
    Rest = 0,
    /// Waiting for the plan; a movement under way goes on meanwhile.
    Plan = 1,
    /// Moving along the plan: out of where the hand is, to the goal.
    Move = 2,
    /// Waiting before the goal for the person to bring the part.
    Await = 3,
    /// Closing the fingers.
    Close = 4,
    /// Feeling whether something is between them.
    Feel = 5,
    /// Staying at the goal.
    Stay = 6,
    /// Opening the fingers.
    Open = 7,
}

impl Errand {
    const ALL: [Self; 9] = [
        Self::Park,
        Self::Take,
        Self::Place,
        Self::PutBack,
        Self::Ask,
        Self::Receive,
        Self::Offer,
        Self::Steady,
        Self::Point,
    ];

    /// From its word in memory.
    pub fn from_word(word: u64) -> Option<Self> {
        Self::ALL.into_iter().find(|errand| *errand as u64 == word)
    }
}

impl Leg {
    const ALL: [Self; 8] =
        [Self::Rest, Self::Plan, Self::Move, Self::Await, Self::Close, Self::Feel, Self::Stay, Self::Open];

    /// From its word in memory.
    pub fn from_word(word: u64) -> Option<Self> {
        Self::ALL.into_iter().find(|leg| *leg as u64 == word)
    }

    /// Whether a new decision must wait until this leg has ended.
    pub fn is_firm(self) -> bool {
        matches!(self, Self::Close | Self::Feel | Self::Open)
    }
}
