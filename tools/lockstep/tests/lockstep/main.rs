//! All stages in lockstep: what they do together.

mod apart;
mod assembly;
mod broken_chain;
mod chapter_5_1;
mod generated;
mod hand;
mod human_partner;
mod joint_motion;
mod large_task;
mod learned;
mod losses;
mod scenarios;
mod separation;
mod shipped;
mod taken_over;
