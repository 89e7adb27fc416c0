//! `coact train`: recordings of people make the model of preshaping that perception reads.

use crate::installation::Installation;
use anyhow::Context;
use coact_reaches::{model_file, train};
use coact_recordings::{Order, read_folder};
use coact_robot::Robot;
use std::path::PathBuf;
use std::process::ExitCode;

/// What `coact train` is asked.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Folder of recorded reaches, one CSV file for each person
    dir: PathBuf,
    /// Where to write the model
    #[arg(long, default_value = "rt-config/perception/preshape.toml")]
    out: PathBuf,
    /// Plan under which perception watches the reaches: only where the hand rests matters
    #[arg(long, default_value = "rt-config/tasks/three-objects.toml")]
    task: PathBuf,
    /// What the file names as the source of the recordings
    #[arg(long, default_value = "github.com/nsoul97/object_size_prediction at 976a346")]
    source: String,
    /// Leave this participant out
    #[arg(long)]
    without: Vec<u32>,
}

/// Trains and writes the model; the same recordings make the same file, bit by bit.
///
/// # Errors
/// When recordings or task are refused, the recordings do not suffice, or the file cannot be written.
pub fn run(args: Args) -> anyhow::Result<ExitCode> {
    let task = coact_joint_task::Task::load(&args.task)?;
    let robot = Robot::load(&Installation::find()?.configuration.join("robots/aros.toml"))?;
    let mut reaches = read_folder(&args.dir)?;
    reaches.retain(|reach| !args.without.contains(&reach.participant));
    let model = train(&task, &robot, &reaches, Order::Trial { seed: 1 })?;
    let text = model_file(&model, &reaches, &args.source)?;
    if let Some(folder) = args.out.parent() {
        std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    }
    std::fs::write(&args.out, text).with_context(|| args.out.display().to_string())?;
    println!("{}: {} reaches", args.out.display(), reaches.len());
    Ok(ExitCode::SUCCESS)
}
