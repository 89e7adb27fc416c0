use coact_messages::topic;
use std::fmt::Debug;

/// Why a port could not be opened or used.
#[derive(Debug, thiserror::Error)]
pub enum PortError {
    /// iceoryx2 refused an operation.
    #[error(
        "topic {topic}: {operation} failed: {problem}; expected programs that were built together, a supervisor that \
         keeps the topic open, and room in shared memory"
    )]
    Refused {
        /// The topic.
        topic: String,
        /// What was tried.
        operation: &'static str,
        /// iceoryx2's reason.
        problem: String,
    },
    /// The process may not join the run.
    #[error("process {process} cannot join the run: {problem}; expected a writable run directory")]
    Join {
        /// The process.
        process: String,
        /// iceoryx2's reason.
        problem: String,
    },
    /// The topic is closed to the process: `coact_messages::topic::ALL` says who may read it.
    #[error("process {process} may not read {topic}; expected {readers}: no other may read it")]
    Closed {
        /// The process that tried to.
        process: String,
        /// The topic.
        topic: String,
        /// The processes that may read it.
        readers: String,
    },
    /// As many viewers read the topic as may.
    #[error(
        "topic {topic}: {viewers} programs outside the set read it already, as many as may; expected one of them to end \
         first: the other places are reserved for the set's own processes"
    )]
    NoPlace {
        /// The topic.
        topic: String,
        /// How many read it.
        viewers: usize,
    },
    /// The process may open nothing any more, and so never again hear a writer that is new, or be heard by a reader that is. The message
    /// contains the cause.
    #[error(
        "topic {topic}: who is new on it cannot be connected: {cause}; expected file handles to be left (ulimit -n)"
    )]
    NoHandles {
        /// The topic.
        topic: String,
        /// The system's reason.
        cause: std::io::Error,
    },
}

impl PortError {
    pub(crate) fn refused(topic: &str, operation: &'static str, problem: impl Debug) -> Self {
        Self::Refused { topic: topic.to_owned(), operation, problem: format!("{problem:?}") }
    }

    pub(crate) fn closed(topic: &str, process: &str) -> Self {
        let readers = topic::find(topic).map_or(String::new(), |entry| entry.readers.join(" or "));
        Self::Closed { process: process.to_owned(), topic: topic.to_owned(), readers }
    }
}
