use crate::Trouble;
use coact_joint_task::{NetworkPlan, Task};
use coact_messages::ARM_JOINTS;
use coact_monitor::Rules;
use coact_pipeline::{RunSettings, WorldMode};
use coact_robot::{JointLimits, Robot};
use coact_safety::SafetyLimits;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// What all runs of a matrix have in common.
#[derive(Debug, Clone)]
pub struct Setup {
    /// The program `coact`.
    pub(crate) coact: PathBuf,
    /// The folder of its configuration.
    pub(crate) configuration: PathBuf,
    pub(crate) seed: u64,
    pub(crate) world: WorldMode,
    pub(crate) task: Task,
    /// Of the arm's joints.
    pub(crate) limits: Vec<JointLimits>,
    /// How old the data of a good command may be.
    pub(crate) fresh: Duration,
    /// What is allowed.
    pub(crate) rules: Rules,
    /// A folder in which runs with a cell that is not green stay.
    pub(crate) kept: Option<PathBuf>,
}

impl Setup {
    /// Sets of the program `coact`, as they are shipped in the folder `configuration`.
    ///
    /// # Errors
    /// A file of the configuration is missing or wrong.
    pub fn load(coact: PathBuf, configuration: &Path, seed: u64, world: WorldMode) -> Result<Self, Trouble> {
        let shipped = RunSettings::shipped(configuration);
        let refused = Trouble::because("the configuration");
        let load = || -> Result<_, Box<dyn std::error::Error>> {
            let (task, _) = NetworkPlan::load(&shipped.task)?;
            let robot = Robot::load(&shipped.robot)?;
            let safety = SafetyLimits::load(&shipped.safety)?;
            Ok((task, robot.limits(), safety, Rules::load(&configuration.join(Rules::FILE))?))
        };
        let (task, limits, safety, rules) = load().map_err(|error| refused(&*error))?;
        let limits = limits[..ARM_JOINTS].to_vec();
        let (configuration, fresh) = (configuration.to_owned(), safety.stale.input_after);
        Ok(Self { coact, configuration, seed, world, task, limits, fresh, rules, kept: None })
    }

    /// What runs with a cell that is not green leave stays in this folder, under the cell's name.
    pub fn keeping(self, folder: PathBuf) -> Self {
        Self { kept: Some(folder), ..self }
    }
}
