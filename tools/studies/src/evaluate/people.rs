//! The people of a folder of recordings, each with a model of preshaping that was made without them.

use crate::train::{ORDER, write_model};
use anyhow::Result;
use coact_evaluation::RecordedPerson;
use coact_joint_task::Task;
use coact_perception::PreshapeModel;
use coact_pipeline::Movement;
use coact_reaches::leave_one_out;
use coact_recordings::{Reach, read_folder};
use coact_robot::Robot;
use std::path::Path;

/// All people of `folder`; their models are written into the folder `models`. What generates a movement is so never what its
/// decoding was made from.
pub(super) fn people(folder: &Path, configuration: &Path, models: &Path) -> Result<Vec<RecordedPerson>> {
    let task = Task::load(&configuration.join("tasks/three-objects.toml"))?;
    let robot = Robot::load(&configuration.join("robots/aros.toml"))?;
    let reaches = read_folder(folder)?;
    let made = leave_one_out(&task, &robot, &reaches, ORDER)?;
    let person = |(participant, made): (u32, PreshapeModel)| {
        let others: Vec<Reach> =
            reaches.iter().filter(|reach| reach.participant != participant).cloned().collect();
        let model = models.join(format!("without-{participant}.toml"));
        write_model(&made, &others, &folder.display().to_string(), &model)?;
        let movement = Movement::Recorded { folder: folder.to_owned(), participant };
        Ok(RecordedPerson { movement, model })
    };
    made.into_iter().map(person).collect()
}
