use crate::plausible::{bounded, index, optional};
use crate::{ArmPath, Flaw, Header, JOINTS, MAX_POPULATIONS, Plausible};
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
    /// The path that the arm follows: what its drive brakes along when commands stop.
    pub path: ArmPath,
    /// Action under way: index into `Task::actions`, or [`NONE`](crate::NONE).
    pub action: u32,
    /// [`MotionPhase`] of that action.
    pub phase: u32,
    /// Movements that changed decisions have begun so far, and how many cycles after its decision the last one began.
    pub begun: u32,
    /// See `begun`.
    pub reaction: u32,
    /// Fraction of its planned speed at which the arm goes on, 0 to 1: less than 1 while the guard holds it back.
    pub speed_override: f64,
    /// 1 while a handover is declared, in which the robot's hand may touch the person's. Else 0.
    pub handover: u32,
    /// Reserved, zero.
    pub reserved: u32,
    /// Control's state, in the words of `coact-stage-state`: what a restarted control resumes from.
    pub state: [f64; 2560],
}

/// Phase of a movement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum MotionPhase {
    /// Standing, with nothing decided.
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
    /// Moving the hand to where a preshaped action begins: nothing is decided.
    Prepare = 9,
}

/// Angles, velocities and accelerations beyond these are none of a joint's, rad, rad/s, rad/s²: far above every robot's
/// limits, which whoever drives the joints keeps.
const MOST: [f64; 3] = [1e2, 1e3, 1e5];

impl MotionPhase {
    /// All of them, in the order of their numbers.
    pub const ALL: [Self; 10] = [
        Self::Rest,
        Self::Reach,
        Self::Approach,
        Self::Grasp,
        Self::Transport,
        Self::Release,
        Self::Retreat,
        Self::Dwell,
        Self::Brake,
        Self::Prepare,
    ];
}

impl Plausible for Command {
    fn check(&self) -> Result<(), Flaw> {
        bounded("position", &self.position, MOST[0])?;
        bounded("velocity", &self.velocity, MOST[1])?;
        bounded("acceleration", &self.acceleration, MOST[2])?;
        bounded("tracking_error", &self.tracking_error, MOST[0])?;
        optional("action", self.action, MAX_POPULATIONS)?;
        index("phase", self.phase, MotionPhase::ALL.len())
    }
}
