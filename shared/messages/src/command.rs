use crate::{Header, JOINTS};
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// What control asks of the joint servos at one tick (1 kHz), and control's own state.
///
/// Every setpoint lies within position, velocity, acceleration and jerk limits, whatever arrived.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
#[type_name("coact::Command")]
pub struct Command {
    /// Header.
    pub header: Header,
    /// Joint position setpoints, rad.
    pub position: [f64; JOINTS],
    /// Joint velocity setpoints, rad/s.
    pub velocity: [f64; JOINTS],
    /// Joint acceleration setpoints, rad/s².
    pub acceleration: [f64; JOINTS],
    /// Measured minus commanded joint position of the last tick, rad.
    pub tracking_error: [f64; JOINTS],
    /// Action under way: index into `Task::actions`, or [`NONE`](crate::NONE).
    pub action: u32,
    /// [`MotionPhase`] of that action.
    pub phase: u32,
    /// Movements that changed decisions have begun so far, and how many cycles after its decision the last one began.
    pub begun: u32,
    /// See `begun`.
    pub reaction: u32,
    /// Control's state, in the words of `coact-stage-state`: what a restarted control resumes from.
    pub state: [f64; 2048],
}

/// Phase of a movement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum MotionPhase {
    /// Standing at the park posture.
    Rest = 0,
    /// Moving the hand to a pose before a grasp, a placing or a gesture.
    Reach = 1,
    /// Straight approach to the part or the socket.
    Approach = 2,
    /// Closing the fingers.
    Grasp = 3,
    /// Moving a held part away, or to where it is used.
    Transport = 4,
    /// Opening the fingers.
    Release = 5,
    /// Moving the empty hand away.
    Retreat = 6,
    /// Standing at the goal: steadying the base, showing the open hand or the part, waiting for the person.
    Dwell = 7,
    /// Braking within limits because inputs stopped, then standing.
    Brake = 8,
}
