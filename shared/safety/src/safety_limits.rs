use crate::{SafetyError, safety_file};
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
}

/// How large the person's arm is taken to be, and for how long it goes on as it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PersonLimits {
    /// Radii of the capsules of upper arm, forearm and hand, m.
    pub radii: [f64; 3],
    /// Length of a hand of which only the wrist is known, m.
    pub hand_length: f64,
    /// A part that the person holds is not farther from the hand than this, m.
    pub carried_within: f64,
    /// For how long the hand is taken to go on at its present velocity.
    pub extrapolated: Duration,
}

/// When the guard slows the arm down, and how it may leave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GuardLimits {
    /// Protective separation: kept between robot and person, m.
    pub protective_separation: f64,
    /// How far ahead the trajectory is looked at.
    pub horizon: Duration,
    /// In how many steps.
    pub horizon_steps: u32,
    /// With less time than this before the separation is violated, the arm may not move on.
    pub stopped_within: Duration,
    /// Speed override at which the arm may leave somebody who is too near, 0 to 1.
    pub escape_override: f64,
    /// How much more distance leaving must bring than standing still, m.
    pub escape_gain: f64,
    /// How much less distance it may bring on the way, m.
    pub escape_loss: f64,
    /// An arm whose speed override is below this is in the person's way, 0 to 1.
    pub blocked_override: f64,
    /// After so long in the person's way, another path is looked for.
    pub blocked: Duration,
}

/// Distances that planned movements keep, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlannerLimits {
    /// From everything, on the way.
    pub path_clearance: f64,
    /// From everything, at the goal.
    pub goal_clearance: f64,
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
    /// Of the newest camera frame that shows the hand.
    pub hand_after: Duration,
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
