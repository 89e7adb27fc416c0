use std::path::PathBuf;

/// Why a recording cannot be replayed.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "each variant is the error of what it names")]
pub enum ReplayError {
    #[error(transparent)]
    Recording(#[from] coact_run_recording::RecordingError),
    #[error("the recording's task: {0}")]
    Task(#[from] coact_joint_task::TaskError),
    #[error("the recording's robot: {0}")]
    Robot(#[from] coact_robot::RobotError),
    #[error("the recording's perception model: {0}")]
    Model(#[from] coact_perception::ModelError),
    #[error("the recording's perception model: {0}")]
    Perception(#[from] coact_perception::SingularModel),
    #[error("the recording's network: {0}")]
    Network(#[from] coact_neural_field::ParameterError),
    #[error("{path}: holds nothing that can be compared; expected percepts and field frames of a run")]
    Nothing { path: PathBuf },
}
