/// Where a message comes from, as iceoryx2 knows it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Origin {
    /// The port that sent it: no two have the same number, and none has 0.
    pub publisher: u128,
    /// Process id of the port's owner.
    pub pid: u32,
}
