use crate::ReplayError;
use coact_fields::Network;
use coact_joint_task::NetworkPlan;
use coact_perception::{Perception, PreshapeModel};
use coact_robot::Robot;
use coact_run_recording::Origin;

/// The stages of a recorded run, made of the files that are in the recording.
pub(crate) struct Stages {
    /// One that has seen nothing yet.
    pub perception: Perception,
    pub network: Network,
}

impl Stages {
    /// # Errors
    /// A file of the recording is missing or malformed.
    pub fn of(origin: &Origin) -> Result<Self, ReplayError> {
        let Origin { settings, files, .. } = origin;
        files.provided(|| {
            let (task, plan) = NetworkPlan::load(&settings.task)?;
            let (robot, model) = (Robot::load(&settings.robot)?, PreshapeModel::load(&settings.model)?);
            Ok(Self {
                perception: Perception::new(&task, &model)?.with_robot(robot),
                network: Network::new(plan, task.fingerprint, settings.seed)?,
            })
        })
    }
}
