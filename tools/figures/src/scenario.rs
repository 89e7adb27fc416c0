use coact_pipeline::{RunSettings, WorldMode};
use std::path::Path;

/// What the person does in a run that is shown: a script of `rt-config/scenarios`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Scenario {
    /// Section 5.1: she idles, mounts a wheel, idles, hands a wheel over.
    Proactive,
    /// Section 5.2: her hand goes behind something that hides it.
    Occlusion,
    /// Section 5.3: she takes a column too early, hands one over, asks for one, mounts one.
    Errors,
}

impl Scenario {
    /// Its script, below `rt-config/scenarios`.
    pub fn file(self) -> &'static str {
        match self {
            Self::Proactive => "proactive.toml",
            Self::Occlusion => "occlusion.toml",
            Self::Errors => "errors-and-requests.toml",
        }
    }

    /// Section of the chapter that describes it.
    pub fn section(self) -> &'static str {
        match self {
            Self::Proactive => "5.1",
            Self::Occlusion => "5.2",
            Self::Errors => "5.3",
        }
    }

    /// The person's actions in it, idling not counted: when they are done, the run has shown all.
    pub(crate) fn actions(self) -> u32 {
        match self {
            Self::Proactive => 2,
            Self::Occlusion => 1,
            Self::Errors => 4,
        }
    }

    /// Number of its first interval: the chapter shows 5.1 and 5.3 as parts of one interaction.
    pub(crate) fn first_interval(self) -> usize {
        match self {
            Self::Proactive | Self::Occlusion => 1,
            Self::Errors => 7,
        }
    }

    pub(crate) fn settings(self, configuration: &Path, seed: u64) -> RunSettings {
        let script = configuration.join("scenarios").join(self.file());
        RunSettings {
            seed,
            partner: format!("script:{}", script.display()),
            world: WorldMode::Kinematic,
            ..RunSettings::shipped(configuration)
        }
    }
}
