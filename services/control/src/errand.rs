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
    /// Moving to the park posture.
    Park = 1,
    /// Searching the postures; a movement under way goes on meanwhile.
    Plan = 2,
    /// Moving to the pose before the goal.
    Reach = 3,
    /// Waiting before the goal for the person to bring the part.
    Await = 4,
    /// Moving straight to the goal.
    Approach = 5,
    /// Closing the fingers.
    Close = 6,
    /// Feeling whether something is between them.
    Feel = 7,
    /// Moving the part away, back along the approach.
    Lift = 8,
    /// Staying at the goal.
    Stay = 9,
    /// Opening the fingers.
    Open = 10,
    /// Moving the hand away, back along the approach.
    Retreat = 11,
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
    const ALL: [Self; 12] = [
        Self::Rest,
        Self::Park,
        Self::Plan,
        Self::Reach,
        Self::Await,
        Self::Approach,
        Self::Close,
        Self::Feel,
        Self::Lift,
        Self::Stay,
        Self::Open,
        Self::Retreat,
    ];

    /// From its word in memory.
    pub fn from_word(word: u64) -> Option<Self> {
        Self::ALL.into_iter().find(|leg| *leg as u64 == word)
    }

    /// Whether a new decision must wait until this leg has ended.
    pub fn is_firm(self) -> bool {
        matches!(self, Self::Close | Self::Feel | Self::Lift | Self::Open | Self::Retreat)
    }

    /// Whether the hand is so close to its goal that it must go back along the approach first.
    pub fn is_close(self) -> bool {
        matches!(self, Self::Approach | Self::Stay)
    }
}
