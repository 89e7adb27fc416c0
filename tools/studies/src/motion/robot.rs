use anyhow::Result;
use clap::ValueEnum;
use coact::installation::Installation;
use coact_joint_task::Task;
use coact_motion::{Mechanism, Meshes};
use coact_motion_suite::Setting;
use coact_robot::{Robot, Urdf};
use std::path::PathBuf;

/// Which robot moves.
#[derive(Debug, clap::Args)]
pub struct RobotArgs {
    /// Robot: a robot file (.toml), or any URDF of an arm of six or seven joints [default: ARoS]
    #[arg(long, value_name = "FILE")]
    robot: Option<PathBuf>,
    /// Hand in place of the robot's own, or for an arm without one: the URDF of a hand alone, z out of its palm
    #[arg(long, value_name = "FILE")]
    hand: Option<PathBuf>,
    /// What to do about meshes of a URDF that are not there
    #[arg(long, value_enum, default_value_t = MissingMeshes::Refuse)]
    missing_meshes: MissingMeshes,
}

/// What takes the place of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum MissingMeshes {
    /// The robot is refused
    Refuse,
    /// Capsules along the links
    Capsules,
}

/// Radius of the capsules that take the place of links' meshes, m: about that of a light arm's links. Chosen by hand.
const CAPSULE_RADIUS: f64 = 0.06;

impl RobotArgs {
    /// Reads the robot. That of a robot file works on the task; that of a URDF alone has none.
    ///
    /// # Errors
    /// What is wrong with its files.
    pub fn setting(&self, task: Option<&PathBuf>) -> Result<Setting> {
        let installation = Installation::find()?;
        let own = installation.configuration.join("robots/aros.toml");
        let file = self.robot.as_ref().unwrap_or(&own);
        let hand = self.hand.as_deref().map(Urdf::load).transpose()?;
        let meshes = match self.missing_meshes {
            MissingMeshes::Refuse => Meshes::Required,
            MissingMeshes::Capsules => Meshes::OrCapsules(CAPSULE_RADIUS),
        };
        if file.extension().is_some_and(|extension| extension == "toml") {
            let toy = installation.configuration.join("tasks/toy-vehicle.toml");
            let task = Task::load(task.unwrap_or(&toy))?;
            let robot = Robot::load(file)?;
            return Ok(match hand {
                None => Setting::of(&robot, task)?,
                Some(hand) => {
                    let mechanism = Mechanism::of(&robot)?.with_hand(&hand, meshes)?;
                    Setting { task: Some(task), ..Setting::foreign(mechanism)? }
                }
            });
        }
        let arm = Urdf::load(file)?;
        let urdf = hand.map_or_else(|| Ok(arm.clone()), |hand| arm.with_hand(&hand))?;
        Ok(Setting::foreign(Mechanism::from_urdf(urdf, meshes)?)?)
    }
}
