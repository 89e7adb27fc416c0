//! What the simulated person does, tick by tick.

mod active;
mod live_hand;
mod scene;
