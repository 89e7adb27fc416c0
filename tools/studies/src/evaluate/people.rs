//! The people of a folder of recordings, each with a model of preshaping that was made without them.

use crate::train::write_model;
use anyhow::{Result, ensure};
use coact_evaluation::RecordedPerson;
use coact_joint_task::Task;
use coact_pipeline::Movement;
use coact_recordings::{Reach, read_folder};
use coact_robot::Robot;
use std::collections::BTreeSet;
use std::path::Path;

/// All people of `folder`; their models are written into the folder `models`. What generates a movement is so never what its
/// decoding was made from.
pub(super) fn people(folder: &Path, configuration: &Path, models: &Path) -> Result<Vec<RecordedPerson>> {
    let task = Task::load(&configuration.join("tasks/three-objects.toml"))?;
    let robot = Robot::load(&configuration.join("robots/aros.toml"))?;
    let reaches = read_folder(folder)?;
    let participants: BTreeSet<u32> = reaches.iter().map(|reach| reach.participant).collect();
    ensure!(participants.len() > 1, "{}: expected reaches of two people or more", folder.display());
    let person = |participant: u32| {
        let others: Vec<Reach> =
            reaches.iter().filter(|reach| reach.participant != participant).cloned().collect();
        let model = models.join(format!("without-{participant}.toml"));
        write_model((&task, &robot), &others, &folder.display().to_string(), &model)?;
        let movement = Movement::Recorded { folder: folder.to_owned(), participant };
        Ok(RecordedPerson { movement, model })
    };
    participants.into_iter().map(person).collect()
}
