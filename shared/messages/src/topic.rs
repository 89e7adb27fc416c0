//! All topics: their names, their messages, and who writes and reads them.
//!
//! [`ALL`] is the one place of these facts. Ports take their rules from it, `docs/processes.svg` is drawn from it, and
//! a whole-system test compares it with what the processes of a running set have opened. Each run's names live under
//! that run's own iceoryx2 prefix.
//!
//! ```
//! use coact_messages::topic;
//!
//! assert_eq!(topic::state_of("fields"), Some(topic::FIELDS));
//! assert!(topic::may_read(topic::TRUTH, "monitor") && !topic::may_read(topic::TRUTH, "control"));
//! assert!(topic::reads("control", topic::FIELDS) && !topic::reads("control", &topic::resume(topic::FIELDS)));
//! assert_eq!(topic::depth(&topic::pulse("world")), 512);
//! assert_eq!(topic::standby("fields").as_deref(), Some("fields-standby"));
//! assert!(topic::reads("fields-standby", topic::PERCEPT) && topic::standby("world").is_none());
//! assert_eq!((topic::writer(topic::TRUTH), topic::writer(topic::HEARD)), (Some("world"), None));
//! ```

use crate::{HandPoints, TopicEntry};
use std::time::Duration;

/// [`SensorSample`](crate::SensorSample), what the sensors tell.
pub const SENSORS: &str = "coact/sensors";
/// [`Percept`](crate::Percept), what perception makes of it.
pub const PERCEPT: &str = "coact/percept";
/// [`FieldFrame`](crate::FieldFrame), the network, and the decision in it.
pub const FIELDS: &str = "coact/fields";
/// [`Command`](crate::Command), setpoints of the joints.
pub const COMMAND: &str = "coact/command";
/// [`Truth`](crate::Truth), what the simulation knows and no sensor tells.
pub const TRUTH: &str = "coact/truth";
/// [`WorldState`](crate::WorldState), the simulation's own state.
pub const WORLD_STATE: &str = "coact/world-state";
/// [`Speech`](crate::Speech) of the robot.
pub const SPEECH: &str = "coact/speech";
/// [`Speech`](crate::Speech) of the person, as text: from `coact say` or a recogniser. The world puts it into the sensor
/// sample.
pub const HEARD: &str = "coact/heard";

/// [`HandPoints`] of a person whose hand comes from outside (`--partner hand`). The world shows it to its
/// tracker.
pub const HAND: &str = "coact/hand";

/// [`StopState`](crate::StopState), whether an operator has stopped the robot.
pub const STOP: &str = "coact/stop";

/// In [`TopicEntry::writers`]: any program outside the set.
pub const ANYONE: &str = "anyone";

/// The stages of the chain, in its order. Each publishes a pulse in each cycle, and resumes from a checkpoint.
const STAGES: &[&str] = &["world", "perception", "fields", "control"];

/// The stages that can have a standby.
pub const WITH_STANDBY: &[&str] = &["fields", "control"];
/// What the name of a standby ends with.
const STANDBY: &str = "-standby";

/// Depth of the chain's topics, which only the newest message matters of: it, and the one that a reader still holds.
const NEWEST: usize = 2;
/// Depth where every cycle's message must arrive at a monitor that looks every 5 ms: half a second of them.
const EVERY_CYCLE: usize = 512;
/// Depth of the sensor samples: the monitor, which looks every 5 ms, measures at the joints what they did in each cycle. It may
/// be held up six times as long; what it then misses, it reports.
const JOINTS_EACH_CYCLE: usize = 32;
/// Depth of the percepts: the recorder, which looks every 2 ms, keeps each of them. It may be held up four times as long; what it
/// then misses, it counts. A trade-off: each message more is 17 kB of shared memory for each reader.
const PERCEPTS_EACH_CYCLE: usize = 8;
/// Depth of spoken sentences: many more than are said while nobody looks.
const SENTENCES: usize = 32;
/// Depth of hands: as many as may come in half of their lifetime.
const HANDS: usize = 32;

/// How long ago the cycle of a message may be that is taken in: no writer of a set is silent for so long and lives, so what is
/// older is a message of long ago that is sent again. Stages have shorter limits of their own. Chosen by hand, far above the
/// watchdog's half second and the second that a monitor may be late.
const LIFETIME: Duration = Duration::from_secs(5);

/// A topic of the chain: of each message the next stage is told by an event.
const CHAIN: TopicEntry = TopicEntry {
    name: "",
    message: "",
    writers: &[],
    readers: &[],
    closed: false,
    announced: true,
    checkpoint: true,
    depth: NEWEST,
    lifetime: Some(LIFETIME),
};
/// Any other topic.
const PLAIN: TopicEntry = TopicEntry { announced: false, checkpoint: false, ..CHAIN };

/// Every topic of a process set: the chain of one cycle in its order, then what stands beside it.
pub const ALL: [TopicEntry; 12] = [
    TopicEntry {
        name: SENSORS,
        message: "SensorSample",
        writers: &["world"],
        readers: &["perception", "control", "monitor", "recorder", "console"],
        checkpoint: false,
        depth: JOINTS_EACH_CYCLE,
        ..CHAIN
    },
    TopicEntry {
        name: PERCEPT,
        message: "Percept",
        writers: &["perception"],
        readers: &["fields", "control", "voice", "recorder", "console", "supervisor"],
        depth: PERCEPTS_EACH_CYCLE,
        ..CHAIN
    },
    TopicEntry {
        name: FIELDS,
        message: "FieldFrame",
        writers: &["fields"],
        // A frame is integrated from the one before: fields reads its own topic.
        readers: &["fields", "control", "voice", "monitor", "recorder", "console", "supervisor"],
        ..CHAIN
    },
    TopicEntry {
        name: COMMAND,
        message: "Command",
        writers: &["control"],
        // Control looks whether its standby has sent the command of a cycle already, and the standby whether control has.
        readers: &["world", "control", "voice", "monitor", "recorder", "console", "supervisor"],
        ..CHAIN
    },
    TopicEntry {
        name: "coact/pulse/*",
        message: "Pulse",
        writers: STAGES,
        readers: &["monitor", "recorder", "console", "supervisor"],
        depth: EVERY_CYCLE,
        ..PLAIN
    },
    TopicEntry {
        name: SPEECH,
        message: "Speech",
        writers: &["voice"],
        readers: &["monitor", "recorder", "supervisor"],
        lifetime: None,
        depth: SENTENCES,
        ..PLAIN
    },
    TopicEntry {
        name: HEARD,
        message: "Speech",
        writers: &[ANYONE, "console"],
        readers: &["world"],
        lifetime: None,
        depth: SENTENCES,
        ..PLAIN
    },
    TopicEntry {
        name: HAND,
        message: "HandPoints",
        writers: &[ANYONE, "console"],
        // Only of a set whose partner's hand comes from outside.
        readers: &["world"],
        lifetime: Some(HandPoints::LIFETIME),
        depth: HANDS,
        ..PLAIN
    },
    TopicEntry {
        name: STOP,
        message: "StopState",
        writers: &["supervisor"],
        // The drive has the last word; what it does, control sees in the sensor sample.
        readers: &["world"],
        ..PLAIN
    },
    TopicEntry {
        name: TRUTH,
        message: "Truth",
        writers: &["world"],
        // Who measures, who records, and who shows. Nobody who decides.
        readers: &["monitor", "recorder", "console"],
        closed: true,
        depth: EVERY_CYCLE,
        ..PLAIN
    },
    TopicEntry {
        name: WORLD_STATE,
        message: "WorldState",
        writers: &["world"],
        readers: &["supervisor"],
        closed: true,
        checkpoint: true,
        ..PLAIN
    },
    TopicEntry {
        name: "coact/*/resume",
        message: "the checkpoint",
        writers: &["supervisor"],
        readers: STAGES,
        lifetime: None,
        ..PLAIN
    },
];

/// [`Pulse`](crate::Pulse) of one process.
pub fn pulse(process: &str) -> String {
    format!("coact/pulse/{process}")
}

/// Name of the standby of a stage; `None` for one that cannot have any.
pub fn standby(process: &str) -> Option<String> {
    WITH_STANDBY.contains(&process).then(|| format!("{process}{STANDBY}"))
}

/// The stage that a process is, or stands by for: a standby reads and writes what its stage does.
pub fn stage(process: &str) -> &str {
    process.strip_suffix(STANDBY).filter(|stage| WITH_STANDBY.contains(stage)).unwrap_or(process)
}

/// The checkpoint of a killed writer of `topic`, published by the supervisor for the writer's replacement.
pub fn resume(topic: &str) -> String {
    format!("{topic}/resume")
}

/// The topic whose newest message is the checkpoint of `process`; `None` for a process that needs none.
pub fn state_of(process: &str) -> Option<&'static str> {
    let stage = stage(process);
    ALL.iter().find(|entry| entry.checkpoint && entry.writers.contains(&stage)).map(|entry| entry.name)
}

/// True if each message of `topic` is announced by an event, so that a process may wait for it.
pub fn announces(topic: &str) -> bool {
    find(topic).is_some_and(|entry| entry.announced)
}

/// How many messages of `topic` a reader may fall behind without losing one.
pub fn depth(topic: &str) -> usize {
    find(topic).map_or(NEWEST, |entry| entry.depth)
}

/// Whether the table has `process` read `topic`. Of the checkpoints a process reads its own.
pub fn reads(process: &str, topic: &str) -> bool {
    let is_own = |of| state_of(process) == Some(of);
    find(topic).is_some_and(|entry| entry.readers.contains(&stage(process)))
        && topic.strip_suffix("/resume").is_none_or(is_own)
}

/// Whether the table has `process` write `topic`. Of the pulses a process writes its own.
pub fn writes(process: &str, topic: &str) -> bool {
    find(topic).is_some_and(|entry| entry.writers.contains(&stage(process)))
        && topic.strip_prefix("coact/pulse/").is_none_or(|of| of == process)
}

/// The one process that writes `topic`, apart from its standby; `None` when anybody may, or for a topic of a program outside the set.
pub fn writer(topic: &str) -> Option<&str> {
    let entry = find(topic)?;
    match entry.name.strip_suffix('*') {
        Some(family) => topic.strip_prefix(family),
        None => entry.writers.first().copied().filter(|writer| *writer != ANYONE),
    }
}

/// Whether `process` may read `topic`.
pub fn may_read(topic: &str, process: &str) -> bool {
    find(topic).is_none_or(|entry| entry.is_open_to(stage(process)))
}

/// The entry of `topic`; `None` for a topic of a program outside the set.
pub fn find(topic: &str) -> Option<&'static TopicEntry> {
    ALL.iter().find(|entry| entry.covers(topic))
}
