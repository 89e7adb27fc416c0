//! The neural-field network: what the person means, whether it is right, and what the robot does about it.
//!
//! Data flow of one tick: what the percept tells of the places that the hand may go to drives the destination field, a field over the table, in
//! which one of them wins; the signals of its peaks, the percept's channels and the previous frame's signals go through the synapse table into
//! each population's input; each layer is integrated from the previous frame straight into the new one; signals,
//! peaks and the decision are read off it. The frame is the whole state: nothing else is remembered.
//!
//! [`Explanation`] tells of any population of a frame what it gets, from where, and why it is wired so.

mod destination_field;
mod due_kinds;
mod explanation;
mod grip_field;
mod likely;
mod network;
mod pooled_input;
mod projections;
mod selection_field;
mod share;
mod sources;

pub use explanation::{Explanation, signals};
pub use network::Network;
use projections::Projections;
pub use share::Share;
