/// When one reach is played, cycles of the run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Span {
    /// First cycle: the hand lies still as in the recording's first frame.
    pub begin: u64,
    /// The recording's time 0: reach onset (label).
    pub onset: u64,
    /// End of the grasp (label).
    pub contact: u64,
    /// First cycle that is not played any more.
    pub end: u64,
}
