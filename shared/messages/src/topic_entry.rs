use std::time::Duration;

/// What is fixed of one topic: its message, its writers and its readers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TopicEntry {
    /// Its name. In the name of a family of topics `*` stands for what tells its members apart.
    pub name: &'static str,
    /// Name of the message's type in this crate; checkpoints have that of the topic that they are of.
    pub message: &'static str,
    /// The processes that write it; [`ANYONE`](crate::topic::ANYONE) for programs outside the set.
    pub writers: &'static [&'static str],
    /// The processes of a set that read it.
    pub readers: &'static [&'static str],
    /// True if nobody else may read it. Other topics are open to operators' tools and programs of one's own.
    pub closed: bool,
    /// True if each message is announced by an event, so that a process may wait for it.
    pub announced: bool,
    /// True if a message holds the whole state of its writer: the newest one is the writer's checkpoint.
    pub checkpoint: bool,
    /// How many messages a reader may fall behind without losing one.
    pub depth: usize,
    /// How old a message may be when it is taken in; `None` when that does not matter.
    pub lifetime: Option<Duration>,
}

impl TopicEntry {
    /// Whether `topic` is this one, or a member of this family.
    pub fn covers(&self, topic: &str) -> bool {
        match self.name.split_once('*') {
            Some((begin, end)) => {
                topic.len() > begin.len() + end.len() && topic.starts_with(begin) && topic.ends_with(end)
            }
            None => topic == self.name,
        }
    }

    /// Whether `process` may read it.
    pub fn is_open_to(&self, process: &str) -> bool {
        !self.closed || self.readers.contains(&process)
    }
}
