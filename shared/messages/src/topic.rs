//! Names of all topics. Each run's names live under that run's own iceoryx2 prefix.

/// [`SensorSample`](crate::SensorSample), world to perception, control and monitor.
pub const SENSORS: &str = "coact/sensors";
/// [`Percept`](crate::Percept), perception to fields and control.
pub const PERCEPT: &str = "coact/percept";
/// [`FieldFrame`](crate::FieldFrame), fields to control, voice, monitor and anyone who wants to look.
pub const FIELDS: &str = "coact/fields";
/// [`Command`](crate::Command), control to world.
pub const COMMAND: &str = "coact/command";
/// [`Truth`](crate::Truth), world to monitor alone.
pub const TRUTH: &str = "coact/truth";
/// [`WorldState`](crate::WorldState), world to the supervisor's keeper alone.
pub const WORLD_STATE: &str = "coact/world-state";
/// [`Speech`](crate::Speech), voice to monitor and supervisor.
pub const SPEECH: &str = "coact/speech";
/// [`Speech`](crate::Speech) of the person, as text: anyone (`coact say`, a recogniser) to world, which puts it into the
/// sensor sample.
pub const HEARD: &str = "coact/heard";

/// [`Pulse`](crate::Pulse) of one process.
pub fn pulse(process: &str) -> String {
    format!("coact/pulse/{process}")
}

/// The surviving last message of `topic`, offered by the keeper to a restarted producer.
pub fn resume(topic: &str) -> String {
    format!("{topic}/resume")
}

/// The topic whose newest message is all the memory that `process` has; `None` for a process that needs none.
pub fn state_of(process: &str) -> Option<&'static str> {
    match process {
        "world" => Some(WORLD_STATE),
        "perception" => Some(PERCEPT),
        "fields" => Some(FIELDS),
        "control" => Some(COMMAND),
        _ => None,
    }
}

/// True if each message of `topic` is announced by an event, so that a process may wait for it.
pub fn announces(topic: &str) -> bool {
    matches!(topic, SENSORS | PERCEPT | FIELDS | COMMAND)
}

/// How many messages of `topic` a reader may fall behind without losing one.
///
/// The chain wants the newest message only. Accounts, truth and sentences must all arrive at a monitor that
/// looks a few times a second.
pub fn depth(topic: &str) -> usize {
    match topic {
        TRUTH => 512,
        SPEECH | HEARD => 32,
        _ if topic.starts_with("coact/pulse/") => 512,
        _ => 2,
    }
}
