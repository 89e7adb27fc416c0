//! Whole assemblies in the physics world: no contact throws a joint beyond its limits.
#![allow(clippy::unwrap_used)]

use coact_lockstep::Lockstep;
use coact_messages::ARM_JOINTS;
use coact_monitor::JointMotion;
use coact_period::CYCLES_PER_SECOND;
use coact_pipeline::{RunSettings, WorldMode};
use coact_robot::Robot;
use std::path::Path;
use std::time::Duration;

/// An assembly takes one minute, and is given two.
const LONGEST: u64 = 120 * CYCLES_PER_SECOND;
/// What `rt-config/verdict.toml` allows in real time, of the acceleration limit.
const ACCELERATION: f64 = 1.05;
const SEEDS: [u64; 2] = [3, 301];
/// So many assemblies at a time.
const CORES: usize = 2;

/// A wheel that met the end of its axle was pressed against it, until it gave way: 15 times the wrist's limit. Fingers that were
/// planned to be as far closed as they were told, not as the part in them let them, struck the base; and a hand that steadied it was
/// pushed aside by the part that the person mounted. The person's part was drawn through a finger with whatever force that took; and a
/// nut that two fingers still pinched was mounted, and stood fast between them, or fell beside its axle before it was let go.
/// A hand on its way to steady the base turned round within it, for it was taken to stand there already (301).
#[test]
fn parts_are_put_into_their_places_within_the_joints_limits() {
    std::thread::scope(|scope| {
        for seeds in SEEDS.chunks(SEEDS.len().div_ceil(CORES)) {
            scope.spawn(|| seeds.iter().copied().for_each(assemble));
        }
    });
}

fn assemble(seed: u64) {
    let config = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    let settings = RunSettings { seed, world: WorldMode::Physics, ..RunSettings::shipped(&config) };
    let limits = Robot::load(&settings.robot).unwrap().limits()[..ARM_JOINTS].to_vec();
    let mut motion = JointMotion::new(limits, Duration::from_secs(1));
    let mut stages = Lockstep::new(&settings).unwrap();
    while !stages.complete() {
        stages.step();
        motion.sample(&stages.sample);
        assert!(stages.ticks() < LONGEST, "seed {seed}: not assembled after {LONGEST} ticks");
    }
    let report = motion.report();
    assert!(report.speed <= 1.0 && report.acceleration <= ACCELERATION, "seed {seed}: {report:?}");
}
