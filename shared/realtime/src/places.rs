//! Who may read a topic, and how many at once: the processes of the set, their replacements, and some viewers.

use crate::PortError;
use crate::any_topic::AnyTopic;
use coact_messages::{TopicEntry, topic};
use iceoryx2::prelude::{CallbackProgression, PortFactory as _};

/// Viewers of one topic: readers that are no process of the set. A trade-off, chosen by hand: each costs the memory of
/// the messages that it may fall behind, 512 pulses for example.
const VIEWERS: usize = 4;
/// Readers of a topic outside the table: a program's own, which knows no reservations. Chosen by hand.
const READERS_OF_OTHER_TOPICS: usize = 8;
/// The supervisor reads the fields twice: for the checkpoint, and to show the run's progress.
const SECOND_READER: usize = 1;

/// How many may read `topic` at once. Each process of the set counts twice, because its replacement takes its own place
/// while that of the dead one is not cleaned up yet.
pub(crate) fn readers(topic: &str) -> usize {
    let Some(entry) = topic::find(topic) else { return READERS_OF_OTHER_TOPICS };
    let own = entry.readers.iter().filter(|process| topic::reads(process, topic));
    let own: usize = own.map(|process| 1 + usize::from(topic::standby(process).is_some())).sum();
    2 * (own + SECOND_READER) + if entry.closed { 0 } else { VIEWERS }
}

/// Whether the reader called `name` is one of the set: a process of the table, or a part of one (`world-speech-input`).
fn belongs_to_set(entry: &TopicEntry, name: &str) -> bool {
    let is_part_of = |process: &&str| {
        name.strip_prefix(process).is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
    };
    entry.readers.iter().any(is_part_of)
}

/// Refuses a viewer that comes when as many read the topic as may.
pub(crate) fn admit(topic: &str, process: &str, service: &AnyTopic) -> Result<(), PortError> {
    let Some(entry) = topic::find(topic).filter(|entry| !belongs_to_set(entry, process)) else {
        return Ok(());
    };
    match viewers(entry, service) {
        viewers if viewers >= VIEWERS => Err(PortError::NoPlace { topic: topic.to_owned(), viewers }),
        _ => Ok(()),
    }
}

fn viewers(entry: &TopicEntry, service: &AnyTopic) -> usize {
    let mut viewers = 0;
    service.dynamic_config().list_subscribers(|reader| {
        viewers += usize::from(!belongs_to_set(entry, reader.subscriber_name.as_str()));
        CallbackProgression::Continue
    });
    viewers
}

/// In words, that no place is left on `topic`; `None` while there is one.
pub(crate) fn crowd(topic: &str, service: &AnyTopic) -> Option<String> {
    let entry = topic::find(topic)?;
    let (taken, places) = (service.dynamic_config().number_of_subscribers(), readers(topic));
    (taken >= places).then(|| {
        let viewers = viewers(entry, service);
        format!("{topic} has no place for another reader: {viewers} of {places} are taken by programs outside the set")
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_reader_belongs_to_the_set_by_its_whole_name() {
        let entry = topic::find(topic::HEARD).unwrap();
        assert!(belongs_to_set(entry, "world") && belongs_to_set(entry, "world-speech-input"));
        assert!(
            !belongs_to_set(entry, "worlds")
                && !belongs_to_set(entry, "")
                && !belongs_to_set(entry, "fields")
        );
    }

    #[test]
    fn closed_topics_have_no_places_for_viewers() {
        assert_eq!(readers(topic::TRUTH), 2 * (3 + SECOND_READER));
        assert_eq!(readers(topic::FIELDS), 2 * (7 + 2 + SECOND_READER) + VIEWERS);
    }
}
