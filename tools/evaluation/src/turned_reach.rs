use serde::Serialize;

/// How the robot followed a person who changed the mind in mid-reach. Times are ms from the assembly's start.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TurnedReach {
    /// When the hand turned: the movement to the new part began.
    pub turned_ms: u64,
    /// When the hand first moved more in the direction of the new part than in that of the old one.
    pub headed_ms: Option<u64>,
    /// What the person was about until then, e.g. "insert: wheel".
    pub chain_before: String,
    /// The subgoal that was meant.
    pub subgoal_before: String,
    /// Whether that stood in IL as the hand turned.
    pub inferred_before: bool,
    /// Whether its complementary action was decided as the hand turned.
    pub decided_before: bool,
    /// Since when the new goal stood in IL, highest of all and without a break until grasp completion; none: it did not stand there then.
    pub followed_ms: Option<u64>,
}

impl TurnedReach {
    /// From the hand's turn until the new goal stood in IL for good, ms; none: it did not.
    pub fn delay_ms(&self) -> Option<i64> {
        Some(self.followed_ms? as i64 - self.turned_ms as i64)
    }

    /// The same from when the hand moved more in the new direction; negative where the goal had followed before.
    pub fn delay_after_heading_ms(&self) -> Option<i64> {
        Some(self.followed_ms? as i64 - self.headed_ms? as i64)
    }
}
