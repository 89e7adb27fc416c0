use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};

/// A motor behaviour that serves an action.
#[derive(Debug, Clone, Copy, PartialEq, Eq, CheckedBitPattern, NoUninit, Zeroable)]
#[repr(u64)]
pub(crate) enum Skill {
    /// Go to the park posture and stand there; a held part stays in the hand.
    Park = 0,
    /// Pick a part from the robot's workspace.
    Pick = 1,
    /// Insert the held part into its socket.
    Insert = 2,
    /// Put the held part back on the table.
    PutBack = 3,
    /// Request a part: hold the open hand out.
    Request = 4,
    /// Receive a part from the person's hand.
    Receive = 5,
    /// Give the held part: hold it out until the person has it.
    Give = 6,
    /// Steady the base.
    Steady = 7,
    /// Point to a part.
    Point = 8,
}

impl Skill {
    /// Whether it brings the held part where it belongs: into its place, or to the person.
    pub fn brings_part(self) -> bool {
        matches!(self, Self::Insert | Self::Give)
    }
}
