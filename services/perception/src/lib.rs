//! Sensor samples to percepts: what the person's hand does, what lies where, how far the construction is.
//!
//! Everything is evidence in [0, 1] that grows with time, never a label: the field network decides. One [`Perception`]
//! takes one [`SensorSample`](coact_messages::SensorSample) in each cycle and writes one
//! [`Percept`](coact_messages::Percept). Cameras are slower than that; in between, evidence is held and the wrist
//! extrapolated, and the percept says how old the newest frame is. Perception never sees truth.
//!
//! - *hand*: keypoints bridged over drop-outs; wrist, speed, pitch; movements from stillness to stillness.
//! - *preshape*: the size of the part that the hand prepares for, learned from other people and adapted to this
//!   person from the reaches so far, without labels ([`PreshapeModel`]).
//! - *targets*: where the hand's way leads. *grips*: how its pitch tells one grip from another.
//! - *objects*: every part that was sighted, who has it, which places are empty.
//! - *hiding*: a reach that has gone out of sight. *loss*: a part that the robot has lost. *words*: what the person says.
//! - *acts*: all of that put together, for each of the task's observable acts.
//!
//! All that lasts from cycle to cycle stands in the percept itself, so that a restarted perception resumes from it.

mod acts;
mod evidence;
mod gestures;
mod grasps;
mod grips;
mod hand;
mod hiding;
mod loss;
mod memory;
mod movement;
mod objects;
mod perception;
mod preshape;
mod targets;
mod words;

pub use perception::{Perception, SingularModel};
pub use preshape::{
    CLASSES, FEATURES, Features, Level, ModelError, PreshapeModel, READ, ReachRecord, SNAPSHOTS, WHOLE,
    WHOLE_LENGTH,
};
