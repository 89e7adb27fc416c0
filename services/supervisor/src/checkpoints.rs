/// The checkpoints of a set's processes, as the supervision needs them.
pub trait Checkpoints {
    /// Publishes the checkpoint of `process`: its replacement is about to be started.
    fn publish(&mut self, process: &str);

    /// A replacement is ready: what its predecessor left in shared memory may be cleaned up now.
    fn recovered(&mut self, process: &str);
}

/// No checkpoints: for programs that send no messages.
impl Checkpoints for () {
    fn publish(&mut self, _: &str) {}
    fn recovered(&mut self, _: &str) {}
}
