use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};

/// What the person's present activity is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, CheckedBitPattern, NoUninit, Zeroable)]
#[repr(u64)]
pub enum Activity {
    /// Take a part of one's own workspace and mount it.
    Insert = 0,
    /// Take it and give it to the robot.
    Give = 1,
    /// Show a gesture that requests a part.
    Request = 2,
    /// Take the part that the robot gives, and mount it.
    Receive = 3,
    /// Take a mounted part out of its socket again, and lay it down.
    Undo = 4,
}
