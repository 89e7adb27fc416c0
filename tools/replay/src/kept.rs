use std::collections::BTreeMap;

/// The newest messages of a topic, by the stamp of their publication: what a stage may have been computed on.
#[derive(Debug)]
pub(crate) struct Kept<T> {
    messages: BTreeMap<u64, Box<T>>,
}

/// A stage takes the newest message that has come, and the newest is kept however old it is; older ones are used while a message is
/// on its way. Chosen by hand: a second of them.
const MOST: usize = 1000;

impl<T> Default for Kept<T> {
    fn default() -> Self {
        Self { messages: BTreeMap::new() }
    }
}

impl<T> Kept<T> {
    pub fn keep(&mut self, published_ns: u64, message: Box<T>) {
        self.messages.insert(published_ns, message);
        if self.messages.len() > MOST {
            self.messages.pop_first();
        }
    }

    /// The one that was published then.
    pub fn published_at(&self, ns: u64) -> Option<&T> {
        self.messages.get(&ns).map(|message| &**message)
    }

    /// The newest one that is like this.
    pub fn newest(&self, is_it: impl Fn(&T) -> bool) -> Option<&T> {
        self.messages.values().rev().map(|message| &**message).find(|message| is_it(message))
    }
}
