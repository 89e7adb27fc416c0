//! Movements that are planned, for our robot and for others.

mod foreign_robots;
mod grips;
mod heartbeat;
mod planning;
mod timing;
