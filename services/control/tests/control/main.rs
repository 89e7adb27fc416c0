//! Control in a world without forces.

mod invariants;
mod kinematic_world;
mod other_instance;
mod preparation;
mod skills;
mod surroundings;
