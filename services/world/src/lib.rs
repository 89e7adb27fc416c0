//! Stands in for the hardware: table, parts, the robot's body, a human partner, and the sensors that see them.
//!
//! The stage is [`World`]. It sees [`Command`](coact_messages::Command)s as the servos do, never a decision, and tells
//! the truth about the person to [`Truth`](coact_messages::Truth) alone. [`Replay`] takes its place where recorded
//! reaches are to be watched as they were made.

mod body;
mod error;
mod memory;
mod noise;
mod parts;
mod person;
mod replay;
mod robot_hand;
mod sensors;
mod settings;
mod slot;
mod staging;
mod world;

pub use error::WorldError;
pub use person::{Rates, Recorded, Script};
pub use replay::{METRES_PER_PIXEL, Replay, Span, has_part_for};
pub use settings::{BodyKind, Partner, Settings};
pub use world::World;
