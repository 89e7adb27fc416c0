//! `coact train`: recordings of people make the model of preshaping that perception reads.

use anyhow::Context;
use coact::installation::Installation;
use coact_joint_task::Task;
use coact_perception::PreshapeModel;
use coact_reaches::{model_file, train};
use coact_recordings::{Order, Reach, read_folder};
use coact_robot::Robot;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// In which order perception is shown each person's reaches.
pub const ORDER: Order = Order::Trial { seed: 1 };

/// Trains the model of preshaping that perception reads.
///
/// The same recordings make the same file, bit by bit.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact train                                     the shipped model, from the shipped recordings
  coact train DIR --out mine.toml                 from other recordings
  coact train --leave-out 3 --out without-3.toml  to test it on this person")]
pub struct Args {
    /// Folder of recorded reaches, one CSV file for each person [default: the shipped data/reaches]
    dir: Option<PathBuf>,
    /// Where to write the model [default: rt-config/perception/preshape.toml]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Plan under which perception watches the reaches: only where the hand rests matters
    /// [default: rt-config/tasks/three-objects.toml]
    #[arg(long, value_name = "FILE")]
    task: Option<PathBuf>,
    /// What the file names as the source of the recordings
    #[arg(long, default_value = "github.com/nsoul97/object_size_prediction at 976a346")]
    source: String,
    /// Leave this participant out; may be repeated
    #[arg(long, value_name = "N")]
    leave_out: Vec<u32>,
}

/// Trains and writes the model.
///
/// # Errors
/// When recordings or task are refused, the recordings do not suffice, or the file cannot be written.
pub fn run(args: Args) -> anyhow::Result<ExitCode> {
    let Installation { configuration, reaches: shipped, .. } = Installation::find()?;
    let below = |file: &str| configuration.join(file);
    let task = Task::load(&args.task.unwrap_or_else(|| below("tasks/three-objects.toml")))?;
    let robot = Robot::load(&below("robots/aros.toml"))?;
    let out = args.out.unwrap_or_else(|| below("perception/preshape.toml"));
    let mut reaches = read_folder(&args.dir.unwrap_or(shipped))?;
    reaches.retain(|reach| !args.leave_out.contains(&reach.participant));
    if let Some(folder) = out.parent() {
        std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    }
    let model = train(&task, &robot, &reaches, ORDER)?;
    write_model(&model, &reaches, &args.source, &out)?;
    println!("{}: {} reaches", out.display(), reaches.len());
    Ok(ExitCode::SUCCESS)
}

/// Writes a model that was made of these reaches; `source` is what the file names as theirs.
pub fn write_model(model: &PreshapeModel, reaches: &[Reach], source: &str, out: &Path) -> anyhow::Result<()> {
    let text = model_file(model, reaches, source)?;
    std::fs::write(out, text).with_context(|| out.display().to_string())
}
