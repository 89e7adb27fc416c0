use coact_robot::{HandGoal, Posture};

/// Where a movement ends.
#[derive(Debug, Clone, PartialEq)]
pub enum Goal {
    /// At whichever of these goals of the hand costs the least change of posture.
    Hand(Vec<HandGoal>),
    /// At this posture, rad.
    Posture(Posture),
}
