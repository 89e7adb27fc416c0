/// What outlives a dead process: the last messages that it had sent.
pub trait Survivors {
    /// Offers the surviving last messages of `process` to its replacement, which is about to be started.
    fn offer(&mut self, process: &str);

    /// A replacement is ready: what the dead one left in shared memory may be cleaned up now.
    fn recovered(&mut self, process: &str);
}

/// Nothing survives: for programs that send no messages.
impl Survivors for () {
    fn offer(&mut self, _: &str) {}
    fn recovered(&mut self, _: &str) {}
}
