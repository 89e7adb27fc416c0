/// The robot's hand as the person sees and feels it.
///
/// Ticks tell since when something has been so; 0: it is not so.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RobotHandView {
    /// The part in the robot's hand.
    pub held: Option<usize>,
    /// Tick since which it has been open and empty where parts change hands.
    pub requesting_since: u64,
    /// Tick since which it has been there with a part that it brought.
    pub giving_since: u64,
    /// Tick since which it has been where the base is steadied.
    pub steadying_since: u64,
    /// The part in the person's hand that is between its open fingers.
    pub receiving: Option<usize>,
}
