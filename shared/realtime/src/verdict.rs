/// What a judge finds of a message that is good by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// It is the topic's next one.
    Next,
    /// Stage and standby both sent one for its cycle, and the other one's came first. It is no fault, and not taken in.
    SentAlready,
}
