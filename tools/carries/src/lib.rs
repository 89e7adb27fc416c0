//! How hands of real people carry, give and withdraw: their ways, out of motion capture.
//!
//! A recording is a file of motion capture with its keyframes beside it, in a folder that is named after what was done. The
//! keyframes tell when a hand had something in it and when it drew back ([`RecordedTask`]); the hand's speed tells where its
//! movements began and ended. What is kept of each is a [`Way`](coact_recordings::Way): its course apart from where it began
//! and how far it led.
//!
//! - The hand is looked at from the body: against the middle of the hip, turned with the shoulders. People walk up to the
//!   table; the simulated person sits.
//! - A movement is a stretch in which the hand is faster than 0.1 m/s, cut where it is slower than 40 % of both peaks beside, and
//!   lengthened until it is as slow as 10 % of its own peak.
//! - Left out are movements in which a body was lost, short ones, detours, and what is no transport at all ([`LeftOut`]).

mod extraction;
mod extraction_error;
mod hand_course;
mod hand_phase;
mod keyframes;
mod left_out;
mod movements;
mod recorded_task;
mod shape;

pub use extraction::{Extraction, extract};
pub use extraction_error::ExtractionError;
pub use left_out::LeftOut;
pub use recorded_task::RecordedTask;
