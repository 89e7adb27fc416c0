//! `coact learn mapping`: which observed act shows which chain, from actions that succeed.

use anyhow::{Result, bail};
use coact::installation::Installation;
use coact_learning::{Connection, Mapping, MappingFile, Provenance};
use coact_lockstep::Lockstep;
use coact_period::cycles;
use coact_pipeline::{RunSettings, WorldMode};
use std::path::{PathBuf, absolute};
use std::process::ExitCode;
use std::time::Duration;

/// Longest assembly: three times what it usually takes.
const LONGEST: u64 = cycles(Duration::from_secs(180));

/// Arguments of `coact learn mapping`.
#[derive(clap::Args)]
#[command(after_help = "Example:
  coact learn mapping --out rt-config/tasks/learned-toy-vehicle.toml

The robot builds with the synthetic partner, under the task's present network, and learns from the
partner's actions that it perceives to succeed. Put learned = \"FILE\" into the task to use it.")]
pub struct Args {
    /// The task [default: the toy vehicle]
    #[arg(long, value_name = "FILE")]
    task: Option<PathBuf>,
    /// How many assemblies are watched
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
    trials: u32,
    /// Seed of the first partner; each further one has the next
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Where the learned connections go
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

/// Learns and writes the connections.
///
/// # Errors
/// A file that is refused or cannot be written, or nothing that succeeded.
pub fn run(args: Args) -> Result<ExitCode> {
    let shipped = RunSettings::shipped(&Installation::find()?.configuration);
    let task = absolute(args.task.unwrap_or_else(|| shipped.task.clone()))?;
    let first = RunSettings { task, seed: args.seed, world: WorldMode::Kinematic, ..shipped };
    let stages = Lockstep::new(&first)?;
    let mut mapping = Mapping::new(stages.task(), stages.plan())?;
    for trial in 0..args.trials {
        let seed = args.seed.wrapping_add(u64::from(trial));
        watch(&mut mapping, &RunSettings { seed, ..first.clone() })?;
        eprintln!("assembly {}: {} successes so far", trial + 1, mapping.successes());
    }
    let (task, successes) = (stages.task().name.clone(), mapping.successes());
    if successes == 0 {
        bail!("no action of the partner succeeded in {} assemblies; try more with --trials", args.trials);
    }
    let connections = mapping.connections();
    connections.iter().for_each(print);
    let provenance = Provenance { task, trials: args.trials, seed: args.seed, successes };
    MappingFile { provenance, connections }.write(&args.out)?;
    println!("written to {}", args.out.display());
    Ok(ExitCode::SUCCESS)
}

/// Learns from one assembly.
fn watch(mapping: &mut Mapping, settings: &RunSettings) -> Result<()> {
    let mut stages = Lockstep::new(settings)?;
    mapping.begin();
    while !stages.complete() && stages.ticks() < LONGEST {
        stages.step();
        mapping.watch(stages.ticks(), &stages.frame, &stages.percept);
    }
    Ok(())
}

fn print(connection: &Connection) {
    let Connection { act, chain, weight, successes } = connection;
    let source = match successes {
        0 => "as with other kinds".into(),
        count => format!("{count} successes"),
    };
    println!("{act:<28} -> {chain:<24} {weight:.2}  {source}");
}
