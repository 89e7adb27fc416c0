//! What the robot decides, in numbers that can be compared between two versions of the program: `cargo run --release -p
//! coact-lockstep --example decisions -- [WORLD] [SECONDS] [SEED...]`; without seeds, 1 to 20 and all shipped scenarios.
//!
//! One line for each run: how many decisions there were, when the first and the last one formed, a hash of all decisions,
//! and hashes of every bit of the fields and of the joint setpoints in all cycles. Equal lines mean equal behaviour.

use coact_lockstep::Lockstep;
use coact_period::CYCLES_PER_SECOND;
use coact_pipeline::{RunSettings, WorldMode};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let world = arguments.next().map_or(Ok(WorldMode::Kinematic), |world| world.parse())?;
    let seconds: u64 = arguments.next().map_or(Ok(60), |seconds| seconds.parse())?;
    let seeds = arguments.map(|seed| seed.parse()).collect::<Result<Vec<u64>, _>>()?;
    let config = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    if seeds.is_empty() {
        for seed in 1..=20 {
            report(&config, seed, "synthetic", world, seconds)?;
        }
        for scenario in scenarios(&config)? {
            report(&config, 1, &format!("script:{scenario}"), world, seconds)?;
        }
    }
    for seed in seeds {
        report(&config, seed, "random", world, seconds)?;
    }
    Ok(())
}

/// Paths of the shipped scenarios, in the order of their names.
fn scenarios(config: &Path) -> std::io::Result<Vec<String>> {
    let files = std::fs::read_dir(config.join("scenarios"))?;
    let paths = files.map(|file| Ok(file?.path().display().to_string()));
    let mut paths = paths.collect::<std::io::Result<Vec<_>>>()?;
    paths.sort();
    Ok(paths)
}

/// Runs one assembly and prints its line.
fn report(
    config: &Path,
    seed: u64,
    partner: &str,
    world: WorldMode,
    seconds: u64,
) -> Result<(), Box<dyn std::error::Error>> {
    let mut stages =
        Lockstep::new(&RunSettings { seed, partner: partner.into(), world, ..RunSettings::shipped(config) })?;
    let [mut decided, mut fields, mut setpoints] = std::array::from_fn(|_| DefaultHasher::new());
    let mut decisions = Vec::new();
    while stages.ticks() < seconds * CYCLES_PER_SECOND {
        stages.step();
        let decision = stages.frame.decision;
        if decisions.last().is_none_or(|(_, last)| *last != decision) {
            (stages.ticks(), decision.action, decision.since).hash(&mut decided);
            decisions.push((stages.ticks(), decision));
        }
        bytes(&stages.frame.activity).hash(&mut fields);
        bytes(&stages.command.position).hash(&mut setpoints);
    }
    let name = Path::new(partner).file_stem().map_or(partner.into(), |name| name.to_string_lossy());
    println!(
        "{name:24} seed {seed:3}: {:3} decisions, last at {:6} ms, decided {:016x} fields {:016x} setpoints {:016x}",
        decisions.len(),
        decisions.last().map_or(0, |(tick, _)| *tick),
        decided.finish(),
        fields.finish(),
        setpoints.finish()
    );
    Ok(())
}

fn bytes(values: &[f64]) -> &[u8] {
    bytemuck::cast_slice(values)
}
