use crate::WorldError;
use crate::person::{Rates, Recorded, Script};
use coact_joint_task::Task;
use std::path::Path;

/// What a world is made with, beside task and robot.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Same seed, same commands: same bits.
    pub seed: u64,
    /// Who the partner is.
    pub partner: Partner,
    /// How the robot's body and loose parts behave.
    pub body: BodyKind,
}

/// How the robot's body and loose parts behave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodyKind {
    /// Joints follow their setpoints, parts rest where they are put: cheap.
    Kinematic,
    /// Rigid-body dynamics with contacts.
    Physics,
}

/// The person who builds with the robot.
#[derive(Debug, Clone)]
pub enum Partner {
    /// Chooses at random among the plan's valid actions, and never errs.
    Synthetic,
    /// Chooses like the synthetic one, but errs, idles and shows its grips unclearly at these rates.
    Random(Rates),
    /// Follows a written sequence of actions.
    Script(Script),
    /// Chooses like the synthetic one; the hand is that of a recorded person.
    Recorded(Recorded),
}

impl Partner {
    /// Reads a partner as it is named on a command line: `synthetic`, `random`,
    /// `random:KEY=VALUE,...` (see [`Rates`]), `script:FILE` or `recorded:DIR`.
    ///
    /// A folder of recordings holds several people: each seed takes another one, in turn.
    ///
    /// # Errors
    /// [`WorldError`] for another word, or for what is wrong in the file or folder.
    pub fn load(name: &str, task: &Task, seed: u64) -> Result<Self, WorldError> {
        match name.split_once(':') {
            None if name == "synthetic" => Ok(Self::Synthetic),
            None if name == "random" => Ok(Self::Random(Rates::default())),
            Some(("random", rates)) => Rates::parse(rates).map(Self::Random),
            Some(("script", file)) => Script::load(Path::new(file), task).map(Self::Script),
            Some(("recorded", folder)) => Recorded::load(Path::new(folder), seed).map(Self::Recorded),
            _ => Err(WorldError::Partner { name: name.to_owned() }),
        }
    }
}
