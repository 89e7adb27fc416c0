//! The network, from percepts made by hand.

mod and_gate;
mod chapter_5_1;
mod chapter_5_2;
mod chapter_5_3;
mod harness;
mod learned_mapping;
mod plans;
