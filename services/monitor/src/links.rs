use crate::Link;
use coact_messages::topic;
use coact_pipeline::{Pipeline, Trigger};

/// Which program sends which topic of the chain, in the chain's order.
const CHAIN: [(&str, &str); 4] = [
    ("coact-world", topic::SENSORS),
    ("coact-perception", topic::PERCEPT),
    ("coact-fields", topic::FIELDS),
    ("coact-control", topic::COMMAND),
];

/// How the processes of a table stand in the chain: all that send pulses, in the order of their start.
pub fn links(pipeline: &Pipeline) -> Vec<Link> {
    let sent_by = |program: &str| CHAIN.iter().find(|(own, _)| *own == program).map(|(_, sent)| *sent);
    let sender = |topic: &str| {
        let mut entries = pipeline.processes.iter();
        entries.find(|entry| sent_by(&entry.program) == Some(topic)).map(|entry| entry.name.clone())
    };
    let link = |entry: &coact_pipeline::ProcessEntry| {
        let input_from = match &entry.trigger {
            Trigger::Topic(topic) => sender(topic),
            // The chain closes: what the first stage reads is the last one's command.
            Trigger::Timer => sender(topic::COMMAND),
            Trigger::None => return None,
        };
        let last = sent_by(&entry.program) == Some(topic::COMMAND);
        Some(Link { process: entry.name.clone(), input_from, last })
    };
    pipeline.processes.iter().filter_map(link).collect()
}
