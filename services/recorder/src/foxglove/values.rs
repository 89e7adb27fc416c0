//! The small values that Foxglove's messages are made of.

use nalgebra::{Isometry3, Point3};
use serde_json::{Value, json};

/// A time, ns since 1970.
pub(crate) fn time(ns: u64) -> Value {
    json!({ "sec": ns / 1_000_000_000, "nsec": ns % 1_000_000_000 })
}

/// A point or a vector, m.
pub(crate) fn point(at: &[f64; 3]) -> Value {
    json!({ "x": at[0], "y": at[1], "z": at[2] })
}

/// A quaternion x, y, z, w.
pub(crate) fn quaternion(turn: &[f64; 4]) -> Value {
    json!({ "x": turn[0], "y": turn[1], "z": turn[2], "w": turn[3] })
}

/// A place and an orientation.
pub(crate) fn pose(at: &[f64; 3], turn: &[f64; 4]) -> Value {
    json!({ "position": point(at), "orientation": quaternion(turn) })
}

/// The place of a frame, m, and its orientation as a quaternion.
pub(crate) fn parts(frame: &Isometry3<f64>) -> ([f64; 3], [f64; 4]) {
    (frame.translation.vector.into(), frame.rotation.coords.into())
}

/// A point of geometry.
pub(crate) fn place(at: &Point3<f64>) -> [f64; 3] {
    at.coords.into()
}

/// A colour: red, green, blue, and how opaque.
pub(crate) fn colour([r, g, b, a]: [f64; 4]) -> Value {
    json!({ "r": r, "g": g, "b": b, "a": a })
}

/// No turn.
pub(crate) const UPRIGHT: [f64; 4] = [0.0, 0.0, 0.0, 1.0];
/// The frame of the world.
pub(crate) const WORLD: &str = "world";
