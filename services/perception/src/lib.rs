//! Sensor samples to percepts: where the person's arm is, what the hand does, what lies where, how far the construction
//! is.
//!
//! Everything is evidence in [0, 1] that grows with time, never a label: the field network decides. One [`Perception`]
//! takes one [`SensorSample`](coact_messages::SensorSample) in each cycle and writes one
//! [`Percept`](coact_messages::Percept). Cameras are slower than that; between their frames evidence stays and the arm is
//! extrapolated, and the percept says how old the newest frame is. Perception never sees truth.
//!
//! - *hand*: keypoints bridged over drop-outs; the arm with its uncertainty; speed and pitch; movements from stillness to
//!   stillness. *present_movement*, *heading*: what the hand is doing, and where it goes.
//! - *reaching*: how well the hand's way so far fits a reach to each part, by what is known of people's reaches ([`MovementModel`]).
//! - *preshape*: the size of the part that the hand prepares for, learned from other people and adapted to this
//!   person from the reaches so far, without labels ([`PreshapeModel`]).
//! - *objects*: every part that was sighted, who has it, which places are empty.
//! - *occlusion*: a reach that has gone out of sight. *loss*: a part that the robot has lost. *words*: what the person says.
//! - *grasps*, *gestures*, *acts*: all of that put together, for each of the task's observable acts.
//!
//! All that lasts from cycle to cycle stands in the percept itself, so that a restarted perception resumes from it.

mod acts;
mod attention;
mod evidence;
mod gestures;
mod grasps;
mod habit;
mod hand;
mod heading;
mod loss;
mod objects;
mod occlusion;
mod perception;
mod perception_state;
mod person_grips;
mod plausible_cycle;
mod pointing;
mod present_movement;
mod preshape;
mod reaching;
mod words;

pub use perception::{Perception, SingularModel};
pub use perception_state::ResumeError;
pub use preshape::{
    CLASSES, FEATURES, Features, Level, ModelError, PreshapeModel, READ, ReachRecord, SNAPSHOTS, WHOLE,
    WHOLE_LENGTH,
};
pub use reaching::{CURVE_BEGINS, CURVE_KNOTS, CURVE_MODES, CURVE_SPACING, MovementModel, TENTH};
