/// From where a hand comes to something that stands upright.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GripSide {
    /// From its top.
    Above,
    /// Across its axis.
    Beside,
}
