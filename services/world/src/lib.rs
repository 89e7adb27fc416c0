//! Stands in for the hardware: table, parts, the robot, a human partner, and the sensors that see them.
//!
//! The stage is [`World`]. It sees [`Command`](coact_messages::Command)s as the servos do, never a decision, and tells
//! the truth about the person to [`Truth`](coact_messages::Truth) alone. The person is a crate of its own,
//! [`coact_person`]. [`Replay`] takes the stage's place where recorded reaches are to be watched as they were made.
//!
//! # Where things are
//!
//! | folder | what |
//! |---|---|
//! | `sensors/` | hand tracker, part recogniser, encoders: their rates, noise, delays and gaps |
//! | `dynamics/` | the simulated robot and the loose parts, with rigid-body dynamics or without |
//! | `scenario/` | the files under `rt-config/scenarios`, and what they arrange in the scene |
//! | `replay/` | recorded reaches, played to the sensors |
//!
//! # What is mounted
//!
//! A part is mounted when it is let go, or comes to rest, in the free socket of its kind: its frame must be within the
//! task's `scene.fit` of the socket's, 8 mm and 8 degrees for the toy vehicle. The same tolerances hold on its way in. A
//! part within them enters what it is mounted in: a wheel or a nut the axle, a column its hole. Any other part meets it
//! as a solid body. Tests bring parts to their places with 0.75 and 1.5 times the tolerated distance, and with 0.75 and 2
//! times the tolerated angle.
//!
//! A column on its hole, or a top floor above the columns, rights itself when it is let go while it leans, and is mounted
//! if it then fits. The top floor has the shape of its handle only: it rests on the columns by this rule, not by contact.
//! The world without dynamics mounts a part within 30 mm of its socket, at any angle.
//!
//! # What is gripped
//!
//! With dynamics, a part is gripped when contact forces say so: 0.5 N from opposing sides for 10 ms. It is lost with less
//! than 0.1 N for 30 ms. A part that is lost by fingers that were not told to open has slipped: it falls through them, and
//! they touch it again once they have been opened. Parts that lie 3 mm beside where they are believed to lie, and are
//! grasped 3 degrees aslant, are lifted, turned, carried and put down in at least 19 of 20 trials.

mod dynamics;
mod error;
mod hand_recording;
mod laid_out;
mod palm;
mod parts;
mod replay;
mod resume_error;
mod robot_hand;
mod robot_hand_state;
mod robot_shape;
mod scenario;
mod sensors;
mod settings;
mod simulation_state;
mod world;

pub use error::WorldError;
pub use hand_recording::HandRecording;
pub use laid_out::laid_out;
pub use replay::{Replay, Span, has_part_for};
pub use resume_error::ResumeError;
pub use scenario::Scenario;
pub use settings::{Partner, Settings};
pub use world::World;
