use crate::{Comfort, SafetyError, safety_file};
use std::path::Path;
use std::time::Duration;

/// All that keeps the person safe, as `rt-config/safety.toml` says it; the file gives the reason of each value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SafetyLimits {
    /// The person's arm as bounding capsules.
    pub person: PersonLimits,
    /// When the arm is slowed down.
    pub guard: GuardLimits,
    /// What planned movements keep clear of.
    pub planner: PlannerLimits,
    /// How old what is used may be.
    pub stale: StaleLimits,
    /// When the side that drives the joints brakes by itself.
    pub drive: DriveLimits,
}

/// How large the person's arm and head are taken to be, and how they may move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PersonLimits {
    /// Radii of the capsules of upper arm, forearm and hand, m.
    pub radii: [f64; 3],
    /// Length of a hand of which only the wrist is known, m.
    pub hand_length: f64,
    /// How far the elbow may be from the shoulder, m.
    pub upper_arm_reach: f64,
    /// How far the wrist may be from the elbow, m.
    pub forearm_reach: f64,
    /// How far the finger tips may be from the wrist, m.
    pub hand_reach: f64,
    /// Length of the arm from the shoulder to the finger tips, m.
    pub reach: f64,
    /// Radius of a capsule around the head, m, and how far it goes up from the shoulder, m.
    pub head_radius: f64,
    /// See `head_radius`.
    pub head_height: f64,
    /// A part that the person holds is not farther from the hand than this, m.
    pub carried_within: f64,
    /// For how long the hand is taken to go on at its present velocity.
    pub extrapolated: Duration,
    /// Speed of a hand, and of somebody who walks, that is not seen, m/s.
    pub hand_speed: f64,
    /// See `hand_speed`.
    pub walking_speed: f64,
    /// What is seen not to move for so long rests.
    pub rests_after: Duration,
    /// What a hand accelerates with, m/s², while it rests, is slow, moves, and is fast; the last two begin at these speeds, m/s.
    pub accelerations: [f64; 4],
    /// See `accelerations`.
    pub speeds: [f64; 2],
    /// By how much a velocity that is measured is older than the position.
    pub velocity_lag: Duration,
}

impl PersonLimits {
    /// What a part of the body that rests, or moves so fast, m/s, may accelerate with, m/s².
    pub fn acceleration(&self, rests: bool, speed: f64) -> f64 {
        let [rest, moves @ ..] = self.accelerations;
        if rests { rest } else { moves[self.speeds.iter().filter(|from| speed >= **from).count()] }
    }
}

/// When the guard slows the arm down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GuardLimits {
    /// Protective separation: the robot never makes it less by its own motion, m.
    pub protective_separation: f64,
    /// Most speed of what is nearer to the person than that, and of the hand in a handover, m/s.
    pub contact_speed: f64,
    /// How much more room an arm that was held back needs to become faster again, m.
    pub hysteresis: f64,
    /// How fast its speed override rises then, 1/s.
    pub quickening: f64,
    /// An arm whose speed override is below this is in the person's way, 0 to 1.
    pub blocked_override: f64,
    /// After so long in the person's way, another path is looked for.
    pub blocked: Duration,
}

/// How fast planned movements are, and the distances that they keep, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlannerLimits {
    /// How much of the hand's speeds is used: of the next one, and of [`GuardLimits::contact_speed`] where it leaves something and comes
    /// to something.
    pub comfort: Comfort,
    /// Most speed of the hand on its way, m/s.
    pub hand_speed: f64,
    /// From everything, on the way.
    pub path_clearance: f64,
    /// From everything, at the goal.
    pub goal_clearance: f64,
    /// The same where a part is brought into its place.
    pub insertion_clearance: f64,
    /// By how much more than the guard a path keeps clear of the person.
    pub beyond_guard: f64,
    /// The person's arm is kept clear of where it is, and where it will be after this time.
    pub person_ahead: Duration,
    /// A hand at rest withdraws first when the person is nearer than this.
    pub withdraw_within: f64,
    /// How far it withdraws.
    pub withdraw_distance: f64,
}

/// Ages beyond which something is not used any more.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StaleLimits {
    /// Of a sensor sample, percept or field frame: beyond it, the arm brakes and stands.
    pub input_after: Duration,
    /// Of the newest camera frame that shows the hand: beyond it, the hand counts as not seen, and may be anywhere that it
    /// can have reached since.
    pub hand_after: Duration,
}

/// When the side that drives the joints brakes by itself, whatever is commanded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DriveLimits {
    /// Without a good command for so long, the joints brake.
    pub command_after: Duration,
    /// So long the joints go on while the driver itself is late, which nobody could tell anything meanwhile; then they brake.
    pub driver_late_after: Duration,
    /// A joint of the arm may be so far from its setpoint, rad ...
    pub tracking_error: f64,
    /// ... and farther only for so long.
    pub tracking_error_after: Duration,
    /// Not having heard for so long whether an operator has stopped the robot, the joints stand.
    pub stop_unheard_after: Duration,
}

impl SafetyLimits {
    /// Reads the limits.
    ///
    /// # Errors
    /// [`SafetyError`]: the file cannot be read, or a key is missing, unknown or out of its range.
    pub fn load(file: &Path) -> Result<Self, SafetyError> {
        let text = coact_input_file::read_text(file)
            .map_err(|source| SafetyError::Unreadable { file: file.to_owned(), source })?;
        Self::parse(&text, file)
    }

    /// The limits that this text says; `file` is named in errors.
    ///
    /// # Errors
    /// [`SafetyError::Invalid`].
    pub fn parse(text: &str, file: &Path) -> Result<Self, SafetyError> {
        safety_file::parse(text).map_err(|fault| fault.in_file(text, file))
    }
}
