use coact_messages::topic;
use coact_pipeline::{Pipeline, ProcessEntry, Trigger};

/// A process that sends pulses, and where its input comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PipelineNode {
    /// Name of the process.
    pub process: String,
    /// Name of the process whose message starts its cycle, if one does.
    pub input_from: Option<String>,
    /// It publishes the command, where end to end ends.
    pub last: bool,
}

/// Which program sends which topic, from sensor to command.
const SENDERS: [(&str, &str); 4] = [
    ("coact-world", topic::SENSORS),
    ("coact-perception", topic::PERCEPT),
    ("coact-fields", topic::FIELDS),
    ("coact-control", topic::COMMAND),
];

impl PipelineNode {
    /// All processes of a table that send pulses, in the order of the table.
    pub fn all(pipeline: &Pipeline) -> Vec<Self> {
        pipeline.processes.iter().filter_map(|entry| Self::new(entry, pipeline)).collect()
    }

    fn new(entry: &ProcessEntry, pipeline: &Pipeline) -> Option<Self> {
        let input_from = match &entry.trigger {
            Trigger::Topic(topic) => sender(topic, pipeline),
            // The circle closes: what the first stage reads is the last one's command.
            Trigger::Timer => sender(topic::COMMAND, pipeline),
            Trigger::None => return None,
        };
        let last = sent_by(&entry.program) == Some(topic::COMMAND);
        Some(Self { process: entry.name.clone(), input_from, last })
    }
}

fn sent_by(program: &str) -> Option<&'static str> {
    SENDERS.iter().find(|(own, _)| *own == program).map(|(_, sent)| *sent)
}

fn sender(topic: &str, pipeline: &Pipeline) -> Option<String> {
    let mut entries = pipeline.processes.iter();
    entries.find(|entry| sent_by(&entry.program) == Some(topic)).map(|entry| entry.name.clone())
}
