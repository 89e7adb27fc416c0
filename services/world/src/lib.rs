//! Stands in for the hardware: table, parts, the robot's body, a human partner, and the sensors that see them.
//!
//! The stage is [`World`]. It sees [`Command`](coact_messages::Command)s as the servos do, never a decision, and tells
//! the truth about the person to [`Truth`](coact_messages::Truth) alone. [`Replay`] takes its place where recorded
//! reaches are to be watched as they were made.
//!
//! # What is mounted
//!
//! A part is mounted when it is let go, or comes to rest, in the free socket of its kind: its frame within the task's
//! `scene.fit` of the socket's, 8 mm and 8 degrees for the toy vehicle. On its way in it may be no farther from the socket's
//! axis than that, and no more turned: a part that stands true enters what it is mounted in (wheel and nut over the axle,
//! column into its hole), any other one meets it as a solid body. Tests bring parts to their places 0.75 and 1.5 times as
//! far aside, 0.75 and 2 times as far turned. A column on its hole, or a top floor above the columns, that is let go while it
//! leans rights itself, and is mounted when it then fits. The top floor's shape is that of its handle: it rests on the
//! columns by this rule, not by contact. The world without dynamics mounts within 30 mm, turned however.
//!
//! # What is gripped
//!
//! With dynamics, fingers hold a part by measured contact: 0.5 N from opposing sides for 10 ms; it is lost with less than
//! 0.1 N for 30 ms. A part that is lost by fingers that were not told to open has slipped: it falls through them, and they
//! touch it again once they have been opened. Parts that lie 3 mm aside of where they are thought to be, and are taken 3
//! degrees aslant, are lifted, turned, carried and put down in 19 of 20 trials or more.

mod dynamics;
mod error;
mod palm;
mod parts;
mod replay;
mod resume_error;
mod robot_hand;
mod robot_hand_state;
mod scenario;
mod sensors;
mod settings;
mod simulation_state;
mod world;

pub use error::WorldError;
pub use replay::{METRES_PER_PIXEL, Replay, Span, has_part_for};
pub use resume_error::ResumeError;
pub use scenario::Scenario;
pub use settings::{Partner, Settings};
pub use world::World;
