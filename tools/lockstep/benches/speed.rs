//! How much faster than real time lockstep is, and what a step of each stage costs while the vehicle is built.
//!
//! `cargo bench -p coact-lockstep`; a number after `--` sets the seconds of the run's own time, 60 by default.
#![allow(missing_docs, clippy::expect_used, reason = "a bench on what is shipped")]

use coact_fields::Network;
use coact_joint_task::NetworkPlan;
use coact_lockstep::Lockstep;
use coact_messages::Percept;
use coact_period::CYCLES_PER_SECOND;
use coact_pipeline::{RunSettings, WorldMode};
use hdrhistogram::Histogram;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Targets, times real time, chosen by hand: what keeps evaluations of a thousand assemblies within an hour or two.
const PHYSICS: f64 = 4.0;
const KINEMATIC: f64 = 30.0;
const FIELDS_ALONE: f64 = 60.0;
/// Target for a step of the network, µs at the 99.9th percentile: 6 % of a period. Chosen by hand.
const NETWORK_STEP_US: f64 = 60.0;
/// The same for a step of the physics world: about a third of a period, for the other stages follow in it.
const PHYSICS_STEP_US: f64 = 350.0;

fn main() {
    let seconds = std::env::args().find_map(|argument| argument.parse().ok()).unwrap_or(60_u64);
    let ticks = seconds * CYCLES_PER_SECOND;
    println!("{seconds} s of the toy vehicle, synthetic partner, seed 1\n");
    report("physics world", ticks, whole(WorldMode::Physics, ticks), PHYSICS);
    report("kinematic world", ticks, whole(WorldMode::Kinematic, ticks), KINEMATIC);
    report("fields alone", ticks, fields_alone(&percepts(ticks)), FIELDS_ALONE);
    println!();
    let physics = steps(WorldMode::Physics, ticks).remove("world").map(|world| ("world, physics", world));
    for (stage, histogram) in steps(WorldMode::Kinematic, ticks).into_iter().chain(physics) {
        let at = |quantile| histogram.value_at_quantile(quantile) as f64 / 1e3;
        let [p50, p99, p999] = [0.5, 0.99, 0.999].map(at);
        let target = match stage {
            "fields" => format!("  (target {NETWORK_STEP_US})"),
            "world, physics" => format!("  (target {PHYSICS_STEP_US})"),
            _ => String::new(),
        };
        println!("{stage:<14} step p50 {p50:6.1} µs  p99 {p99:6.1} µs  p99.9 {p999:6.1} µs{target}");
    }
}

fn report(name: &str, ticks: u64, taken: Duration, target: f64) {
    let times = ticks as f64 / CYCLES_PER_SECOND as f64 / taken.as_secs_f64();
    println!("{name:<16} {times:6.1} times real time  (target {target})");
}

fn settings(world: WorldMode) -> RunSettings {
    let configuration = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    RunSettings { world, ..RunSettings::shipped(&configuration) }
}

fn lockstep(world: WorldMode) -> Lockstep {
    Lockstep::new(&settings(world)).expect("what is shipped is valid")
}

fn whole(world: WorldMode, ticks: u64) -> Duration {
    let mut stages = lockstep(world);
    let begin = Instant::now();
    (0..ticks).for_each(|_| stages.step());
    begin.elapsed()
}

/// What perception says in such a run, every tenth of it.
fn percepts(ticks: u64) -> Vec<Percept> {
    let mut stages = lockstep(WorldMode::Kinematic);
    let mut percepts = Vec::new();
    for tick in 0..ticks {
        stages.step();
        if tick % 10 == 0 {
            percepts.push(*stages.percept);
        }
    }
    percepts
}

fn fields_alone(percepts: &[Percept]) -> Duration {
    let (task, plan) = NetworkPlan::load(&settings(WorldMode::Kinematic).task).expect("the task is valid");
    let mut network = Network::new(plan, task.fingerprint, 1).expect("the network is valid");
    let (mut now, mut next) = (bytemuck::zeroed_box(), bytemuck::zeroed_box());
    network.rest(&mut now);
    let begin = Instant::now();
    for tick in 0..10 * percepts.len() as u64 {
        network.step(tick, Some(&percepts[tick as usize / 10]), &now, &mut next);
        std::mem::swap(&mut now, &mut next);
    }
    begin.elapsed()
}

/// Duration of every stage's steps, ns.
fn steps(world: WorldMode, ticks: u64) -> BTreeMap<&'static str, Histogram<u64>> {
    let mut stages = lockstep(world);
    let mut taken: BTreeMap<&'static str, Histogram<u64>> = BTreeMap::new();
    for _ in 0..ticks {
        stages.step_watched(&mut |stage, step| {
            let begin = Instant::now();
            step();
            let own = taken.entry(stage).or_insert_with(coact_monitor::histogram);
            own.saturating_record(begin.elapsed().as_nanos() as u64);
        });
    }
    taken
}
