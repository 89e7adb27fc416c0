//! Names of all topics. Each run's names live under that run's own iceoryx2 prefix.

/// [`SensorSample`](crate::SensorSample), world to perception and control.
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

/// [`Pulse`](crate::Pulse) of one process.
pub fn pulse(process: &str) -> String {
    format!("coact/pulse/{process}")
}

/// The surviving last message of `topic`, offered by the keeper to a restarted producer.
pub fn resume(topic: &str) -> String {
    format!("{topic}/resume")
}
