/// What of the robot's the person can do nothing but wait for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u32)]
pub enum PersonWait {
    /// Nothing: the person acts, or rests by choice.
    Nothing = 0,
    /// With a part at its place, until the base is steadied.
    Steadying = 1,
    /// Holding a part out, until the robot has it.
    Receiving = 2,
    /// Holding the open hand out, until the robot gives what is asked for.
    Part = 3,
    /// With the fingers on a part, until the robot lets it go.
    Release = 4,
    /// At rest, until the robot has achieved a step of its own: nothing else can be done before.
    Subgoal = 5,
}

impl PersonWait {
    /// All of them, in the order of their numbers.
    pub const ALL: [Self; 6] =
        [Self::Nothing, Self::Steadying, Self::Receiving, Self::Part, Self::Release, Self::Subgoal];

    /// Whether it is in the middle of an action.
    pub fn is_within_action(self) -> bool {
        !matches!(self, Self::Nothing | Self::Subgoal)
    }
}
