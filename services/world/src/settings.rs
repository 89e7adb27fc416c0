use crate::{HandRecording, Scenario, WorldError};
use coact_joint_task::Task;
use coact_person::{Habits, RandomBehaviour, RecordedArm, RecordedReaches, RecordedWays};
use coact_pipeline::{Movement, RunSettings, WorldMode};
use coact_recordings::ArmSide;
use coact_safety::DriveLimits;
use std::path::Path;

/// What a world is made with, beside task and robot.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Same seed, same commands: same bits.
    pub seed: u64,
    /// Who the partner is.
    pub partner: Partner,
    /// How people show grips and gestures.
    pub habits: Habits,
    /// Reaches that move the person's hand in place of the model's, where the partner has none of its own.
    pub reaches: Option<RecordedReaches>,
    /// Ways along which the person carries, gives and withdraws, in place of straight ones.
    pub ways: Option<RecordedWays>,
    /// How the robot and loose parts behave.
    pub mode: WorldMode,
    /// When the drive brakes by itself.
    pub drive: DriveLimits,
}

impl Settings {
    /// Those of a run in which this task is built.
    ///
    /// # Errors
    /// As [`Partner::load`]; recordings of the movement, or ways beside recorded reaches, that cannot
    /// be used.
    pub fn of_run(run: &RunSettings, task: &Task, drive: DriveLimits) -> Result<Self, WorldError> {
        let reaches = match &run.movement {
            Movement::MinimumJerk => None,
            Movement::Recorded { folder, participant } => {
                Some(RecordedReaches::load_participant(folder, *participant)?)
            }
        };
        let partner = Partner::load(&run.partner, task, run.seed)?;
        let habits = Habits::load(&run.person, task)?;
        let is_recorded = reaches.is_some() || matches!(partner, Partner::Recorded(_));
        let ways = if is_recorded { Some(RecordedWays::load(&run.carries)?) } else { None };
        Ok(Self { seed: run.seed, partner, habits, reaches, ways, mode: run.world, drive })
    }
}

/// The person who builds with the robot.
#[derive(Debug, Clone)]
pub enum Partner {
    /// Chooses at random among the plan's valid actions, and makes no mistakes.
    Synthetic,
    /// Chooses like the synthetic one, loses no time, and prepares what comes next.
    Active,
    /// Chooses like the synthetic one, but makes mistakes, idles and shows its grips unclearly.
    Random(RandomBehaviour),
    /// Follows a written sequence of actions, in a scene that is arranged for it.
    Script(Scenario),
    /// Chooses like the synthetic one; the hand is that of a recorded person.
    Recorded(RecordedReaches),
    /// Moves an arm as it was recorded, whatever the robot does, and takes no part in the task.
    Arm(RecordedArm),
    /// Moves the hand as a person's was seen to move in a recorded run.
    Again(HandRecording),
    /// Moves a hand that is told from outside ([`World::show_hand`](crate::World::show_hand)).
    Hand,
}

impl Partner {
    /// The name of a partner whose hand comes from outside.
    pub const HAND: &str = RunSettings::HAND;

    /// Reads a partner as it is named on a command line: `synthetic`, `active`, `random`,
    /// `random:KEY=VALUE,...` (see [`RandomBehaviour`]), `script:FILE`, `recorded:DIR`, `recorded:FILE.mcap`, `left-arm:FILE`,
    /// `right-arm:FILE` or `hand`.
    ///
    /// A folder of recordings holds several people: each seed takes another one, in turn. An arm of motion capture is put
    /// elsewhere by each seed.
    ///
    /// # Errors
    /// [`WorldError`] for another word, or for what is wrong in the file or folder.
    pub fn load(name: &str, task: &Task, seed: u64) -> Result<Self, WorldError> {
        match name.split_once(':') {
            None if name == "synthetic" => Ok(Self::Synthetic),
            None if name == "active" => Ok(Self::Active),
            None if name == Self::HAND => Ok(Self::Hand),
            None if name == "random" => Ok(Self::Random(RandomBehaviour::default())),
            Some(("random", settings)) => Ok(Self::Random(RandomBehaviour::parse(settings)?)),
            Some(("script", file)) => Scenario::load(Path::new(file), task).map(Self::Script),
            Some(("recorded", file)) if file.ends_with(HandRecording::EXTENSION) => {
                HandRecording::load(Path::new(file)).map(Self::Again)
            }
            Some(("recorded", folder)) => Ok(Self::Recorded(RecordedReaches::load(Path::new(folder), seed)?)),
            Some(("left-arm", file)) => Self::arm(file, ArmSide::Left, task, seed),
            Some(("right-arm", file)) => Self::arm(file, ArmSide::Right, task, seed),
            _ => Err(WorldError::Partner { name: name.to_owned() }),
        }
    }

    fn arm(file: &str, side: ArmSide, task: &Task, seed: u64) -> Result<Self, WorldError> {
        Ok(Self::Arm(RecordedArm::load(Path::new(file), side, &task.scene, seed)?))
    }
}
