use crate::{Layout, Movement};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// What a run is made of: every process finds it in the run directory. Paths are absolute.
///
/// The default names no file: enough for a run of ports alone, as in examples and tests.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunSettings {
    /// The task file.
    pub task: PathBuf,
    /// The robot file; it names the URDF.
    pub robot: PathBuf,
    /// The perception model.
    pub model: PathBuf,
    /// The process table.
    pub pipeline: PathBuf,
    /// The limits that keep the person safe.
    pub safety: PathBuf,
    /// How simulated people show grips and gestures.
    pub person: PathBuf,
    /// Where reports go; it outlives the run.
    pub report: PathBuf,
    /// Seed of every random generator of the run.
    pub seed: u64,
    /// The partner: `synthetic`, `active`, `script:FILE`, `recorded:DIR`, `recorded:FILE.mcap`, `left-arm:FILE`, `right-arm:FILE` or `hand`; or `replay:PARTICIPANT:DIR`, a person's recorded
    /// reaches, played to the sensors in place of a world.
    pub partner: String,
    /// Where the parts lie when an assembly begins.
    #[serde(default)]
    pub layout: Layout,
    /// How the person's hand reaches, unless the partner is one that has a movement of its own.
    #[serde(default)]
    pub movement: Movement,
    /// The ways along which a person carries, gives and withdraws whose reaches are recorded ones.
    #[serde(default)]
    pub carries: PathBuf,
    /// How the world computes.
    pub world: WorldMode,
    /// How long the run lasts; without it, until all subgoals are achieved, or the supervisor has waited long enough.
    #[serde(default)]
    pub duration: Option<Duration>,
    /// Processes of the table that are started although it says `on_request`: those that the operator asks for.
    #[serde(default)]
    pub requested: Vec<String>,
}

impl RunSettings {
    /// The partner whose hand comes from outside.
    pub const HAND: &str = "hand";

    /// The toy vehicle and ARoS with the synthetic partner, in the physics world, seed 1, without a report: all that is
    /// shipped in the folder `rt_config`, and in `data` beside it. To be varied with `..RunSettings::shipped(rt_config)`.
    pub fn shipped(rt_config: &Path) -> Self {
        Self {
            task: rt_config.join("tasks/toy-vehicle.toml"),
            robot: rt_config.join("robots/aros.toml"),
            model: rt_config.join("perception/preshape.toml"),
            pipeline: rt_config.join("pipeline.toml"),
            safety: rt_config.join("safety.toml"),
            person: rt_config.join("person.toml"),
            report: PathBuf::new(),
            seed: 1,
            partner: "synthetic".into(),
            layout: Layout::Task,
            movement: Movement::MinimumJerk,
            carries: rt_config.with_file_name("data/carries/carries.csv"),
            world: WorldMode::Physics,
            duration: None,
            requested: Vec::new(),
        }
    }
}

/// How the world computes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum WorldMode {
    /// Rigid bodies with contact forces.
    #[default]
    Physics,
    /// Same sensors and truth, without contact forces.
    Kinematic,
}

impl WorldMode {
    /// As it is given and told.
    pub fn name(self) -> &'static str {
        match self {
            Self::Physics => "physics",
            Self::Kinematic => "kinematic",
        }
    }
}

impl std::str::FromStr for WorldMode {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "physics" => Ok(Self::Physics),
            "kinematic" => Ok(Self::Kinematic),
            _ => Err(format!("world \"{text}\" is unknown; expected physics or kinematic")),
        }
    }
}
