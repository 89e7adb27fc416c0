use coact_messages::Header;
use std::collections::BTreeMap;

/// Counts the messages that did not come, by their sequences.
#[derive(Debug, Default)]
pub struct Gaps {
    newest: BTreeMap<String, Header>,
    lost: BTreeMap<String, u64>,
    /// Whether the first message of all is awaited: not by a recorder that joins later.
    from_the_start: bool,
}

impl Gaps {
    /// Of a recorder that hears the run from its first message on, or joins it later.
    pub fn new(from_the_start: bool) -> Self {
        Self { from_the_start, ..Self::default() }
    }

    /// A message has come.
    pub fn heard(&mut self, topic: &str, header: &Header) {
        let expected = match self.newest.get(topic) {
            // A writer that found no checkpoint counts from the beginning.
            Some(newest) if header.generation != newest.generation && header.sequence <= newest.sequence => 0,
            Some(newest) => newest.sequence + 1,
            None if self.from_the_start => 0,
            None => header.sequence,
        };
        let missing = header.sequence.saturating_sub(expected);
        if missing > 0 {
            self.lose(topic, missing);
        }
        match self.newest.get_mut(topic) {
            Some(newest) => *newest = *header,
            None => drop(self.newest.insert(topic.to_owned(), *header)),
        }
    }

    /// So many messages of a topic came, and were not kept.
    pub fn lose(&mut self, topic: &str, count: u64) {
        *self.lost.entry(topic.to_owned()).or_default() += count;
    }

    /// How many were lost, by topic.
    pub fn lost(&self) -> &BTreeMap<String, u64> {
        &self.lost
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_between_two_messages_is_counted_also_across_a_restart() {
        let mut gaps = Gaps::new(true);
        let mut heard = |generation, sequence| {
            gaps.heard("t", &Header { generation, sequence, ..Header::default() });
            gaps.lost().get("t").copied().unwrap_or(0)
        };
        assert_eq!([heard(0, 0), heard(0, 1), heard(0, 4)], [0, 0, 2]);
        assert_eq!([heard(1, 5), heard(1, 7)], [2, 3], "resumed, and one lost");
        assert_eq!([heard(2, 0), heard(2, 1)], [3, 3], "begun anew");
        assert_eq!(Gaps::new(false).lost().len(), 0);
    }
}
