//! What perception makes of a hand and of parts that a test moves.

mod acts;
mod either_hand;
mod parts;
mod person_arm;
mod robustness;
mod support;
mod taken_out;
mod words;
