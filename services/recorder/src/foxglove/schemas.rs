//! The schemas of Foxglove's messages, as far as ours use them.

use coact_run_recording::JsonSchema;
use serde_json::{Map, Value, json};

fn object<const COUNT: usize>(fields: [(&str, Value); COUNT]) -> Value {
    let properties: Map<String, Value> = fields.into_iter().map(|(name, of)| (name.to_owned(), of)).collect();
    json!({ "type": "object", "properties": properties })
}

fn list(items: Value) -> Value {
    json!({ "type": "array", "items": items })
}

fn number() -> Value {
    json!({ "type": "number" })
}

fn integer() -> Value {
    json!({ "type": "integer" })
}

fn text() -> Value {
    json!({ "type": "string" })
}

fn truth() -> Value {
    json!({ "type": "boolean" })
}

fn time() -> Value {
    let mut time = object([("sec", integer()), ("nsec", integer())]);
    time["title"] = "time".into();
    time
}

fn duration() -> Value {
    let mut duration = object([("sec", integer()), ("nsec", integer())]);
    duration["title"] = "duration".into();
    duration
}

fn vector() -> Value {
    object([("x", number()), ("y", number()), ("z", number())])
}

fn quaternion() -> Value {
    object([("x", number()), ("y", number()), ("z", number()), ("w", number())])
}

fn pose() -> Value {
    object([("position", vector()), ("orientation", quaternion())])
}

fn colour() -> Value {
    object([("r", number()), ("g", number()), ("b", number()), ("a", number())])
}

fn schema(name: &'static str, value: Value) -> JsonSchema {
    JsonSchema { name, text: value.to_string() }
}

/// Where frames are.
pub(crate) fn frame_transforms() -> JsonSchema {
    let transform = object([
        ("timestamp", time()),
        ("parent_frame_id", text()),
        ("child_frame_id", text()),
        ("translation", vector()),
        ("rotation", quaternion()),
    ]);
    schema("foxglove.FrameTransforms", object([("transforms", list(transform))]))
}

/// The angles of joints.
pub(crate) fn joint_states() -> JsonSchema {
    let joint = object([("name", text()), ("position", number()), ("velocity", number())]);
    schema("foxglove.JointStates", object([("timestamp", time()), ("joints", list(joint))]))
}

/// A line of a log.
pub(crate) fn log() -> JsonSchema {
    let line = object([
        ("timestamp", time()),
        ("level", integer()),
        ("message", text()),
        ("name", text()),
        ("file", text()),
        ("line", integer()),
    ]);
    schema("foxglove.Log", line)
}

/// Shapes in space.
pub(crate) fn scene_update() -> JsonSchema {
    let cube = object([("pose", pose()), ("size", vector()), ("color", colour())]);
    let line = object([
        ("type", integer()),
        ("pose", pose()),
        ("thickness", number()),
        ("scale_invariant", truth()),
        ("points", list(vector())),
        ("color", colour()),
        ("colors", list(colour())),
        ("indices", list(integer())),
    ]);
    let words = object([
        ("pose", pose()),
        ("billboard", truth()),
        ("font_size", number()),
        ("scale_invariant", truth()),
        ("color", colour()),
        ("text", text()),
    ]);
    let nothing = || list(json!({ "type": "object" }));
    let entity = object([
        ("timestamp", time()),
        ("frame_id", text()),
        ("id", text()),
        ("lifetime", duration()),
        ("frame_locked", truth()),
        ("metadata", nothing()),
        ("arrows", nothing()),
        ("cubes", list(cube)),
        ("spheres", nothing()),
        ("cylinders", nothing()),
        ("lines", list(line)),
        ("triangles", nothing()),
        ("texts", list(words)),
        ("models", nothing()),
    ]);
    schema("foxglove.SceneUpdate", object([("deletions", nothing()), ("entities", list(entity))]))
}
