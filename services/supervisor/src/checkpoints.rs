/// What the supervision needs of a set's topics: the checkpoints of its processes, and places for their ports.
pub trait Checkpoints {
    /// Publishes the checkpoint of `process`, and frees what is reserved for its replacement: that is about to be started. In
    /// words, what is lost where there is no checkpoint; `None` when there is one, or it needs none.
    fn publish(&mut self, process: &str) -> Option<String>;

    /// What is published next for `process` is spoiled: an injected fault.
    fn poison(&mut self, _process: &str) {}

    /// The checkpoint of `process` ended a replacement that took it up: it is never published again. In words, what is lost;
    /// `None` when there was none.
    fn drop_newest(&mut self, _process: &str) -> Option<String> {
        None
    }

    /// In words, that a topic which `process` reads has no place left for it; `None` while all have.
    fn crowd(&self, _process: &str) -> Option<String> {
        None
    }

    /// A replacement is ready: what its predecessor left in shared memory may be cleaned up now.
    fn recovered(&mut self, process: &str);
}

/// No checkpoints: for programs that send no messages.
impl Checkpoints for () {
    fn publish(&mut self, _: &str) -> Option<String> {
        None
    }
    fn recovered(&mut self, _: &str) {}
}
