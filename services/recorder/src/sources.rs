use crate::RecorderSettings;
use anyhow::Context;
use coact_input_file::{Files, read_text};
use coact_joint_task::{NetworkPlan, Task};
use coact_pipeline::RunSettings;
use coact_robot::Robot;

/// What a run is made of: its files, as all stages read them, and what of them is needed to show it.
#[derive(Debug)]
pub struct Sources {
    pub(crate) task: Task,
    pub(crate) robot: Robot,
    pub(crate) files: Files,
    pub(crate) own: RecorderSettings,
}

impl Sources {
    /// Reads all of it.
    ///
    /// # Errors
    /// A file cannot be read, or is malformed.
    pub fn load(settings: &RunSettings) -> anyhow::Result<Self> {
        let folder = settings.pipeline.parent().context("the process table stands in no folder")?;
        let own = RecorderSettings::load(&folder.join(RecorderSettings::FILE))?;
        let (loaded, files) = Files::noted(|| -> anyhow::Result<_> {
            for file in [&settings.model, &settings.safety, &settings.pipeline] {
                read_text(file).with_context(|| file.display().to_string())?;
            }
            Ok((NetworkPlan::load(&settings.task)?.0, Robot::load(&settings.robot)?))
        });
        let (task, robot) = loaded?;
        Ok(Self { task, robot, files, own })
    }

    /// How much is recorded of what is large.
    pub fn settings(&self) -> RecorderSettings {
        self.own
    }
}
