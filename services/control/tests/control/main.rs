//! Control in a world without forces.

mod invariants;
mod kinematic_world;
mod other_instance;
mod skills;
mod surroundings;
