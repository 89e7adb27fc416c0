//! One assembly in lockstep, told line by line: `cargo run -p coact-lockstep --example assemble -- [SEED] [PARTNER] [SECONDS] [WORLD]`.

use coact_lockstep::Lockstep;
use coact_messages::{ARM_JOINTS, LayerKind, NONE};
use coact_monitor::JointMotion;
use coact_period::{CYCLES_PER_SECOND, seconds};
use coact_pipeline::{RunSettings, WorldMode};
use coact_robot::Robot;
use std::path::Path;
use std::time::Duration;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let seed = arguments.next().map_or(Ok(1), |seed| seed.parse())?;
    let partner = arguments.next().unwrap_or_else(|| "synthetic".into());
    let duration: u64 = arguments.next().map_or(Ok(200), |seconds| seconds.parse())?;
    let world = arguments.next().map_or(Ok(WorldMode::Kinematic), |world| world.parse())?;
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    let shipped = RunSettings::shipped(&folder);
    let model = std::env::var("MODEL").map_or_else(|_| shipped.model.clone(), Into::into);
    let limits = Robot::load(&shipped.robot)?.limits()[..ARM_JOINTS].to_vec();
    let mut motion = JointMotion::new(limits, Duration::from_secs(1));
    let mut stages = Lockstep::new(&RunSettings { model, seed, partner, world, ..shipped })?;
    let mut last = String::new();
    let mut errors = Vec::new();
    let started = std::time::Instant::now();
    while stages.ticks() < duration * CYCLES_PER_SECOND && !stages.complete() {
        stages.step();
        errors.push(tracking_error(&stages));
        motion.sample(&stages.sample);
        let now = describe(&stages);
        if now != last {
            println!("{:8.3} {now}", seconds(stages.ticks()));
            last = now;
        }
    }
    for part in &stages.state.part[..stages.state.parts as usize] {
        let name = &stages.task().kinds[part.kind as usize].name;
        println!(
            "{name}: {:.3?} {:.2?} state {} goal {}",
            part.position, part.orientation, part.state, part.subgoal as i32
        );
    }
    let (ticks, elapsed) = (stages.ticks(), started.elapsed().as_secs_f64());
    let largest = (0..errors.len()).max_by(|one, other| errors[*one].total_cmp(&errors[*other])).unwrap_or(0);
    println!(
        "tracking error: more than 20 mrad for {} ms, largest {:.1} mrad at {:.3} s",
        errors.iter().filter(|error| **error > 0.02).count(),
        1e3 * errors.get(largest).copied().unwrap_or(0.0),
        seconds(largest as u64)
    );
    let joints = motion.report();
    let (speed_at, acceleration_at) = (joints.speed_at, joints.acceleration_at);
    println!(
        "joints: at most {:.3} of the speed (joint {} at {:.3} s) and {:.3} of the acceleration limit (joint {} at {:.3} s)",
        joints.speed,
        speed_at.joint,
        speed_at.s,
        joints.acceleration,
        acceleration_at.joint,
        acceleration_at.s
    );
    println!("{} ms in {elapsed:.2} s: {:.1} times real time", ticks, seconds(ticks) / elapsed);
    Ok(())
}

/// Largest difference of an arm joint's measured angle from its setpoint in this tick, rad.
fn tracking_error(stages: &Lockstep) -> f64 {
    let errors = &stages.command.tracking_error[..ARM_JOINTS];
    errors.iter().fold(0.0, |largest: f64, error| largest.max(error.abs()))
}

/// Everything that a person watching would want to know of this tick, in one line.
fn describe(stages: &Lockstep) -> String {
    let (task, plan, frame, truth) = (stages.task(), stages.plan(), &stages.frame, &stages.truth);
    let peaks = |layer| {
        let populations = plan.layer(layer).populations.clone();
        let standing = populations.filter(|&population| frame.signal[population] > 0.5);
        standing.map(|population| plan.populations[population].label.as_str()).collect::<Vec<_>>().join(", ")
    };
    let decision = match frame.decision.action {
        NONE => "-",
        action => &task.actions[action as usize].name,
    };
    let chain = match truth.chain {
        NONE => "-".into(),
        chain => format!(
            "{} {}",
            task.chains[chain as usize].name, task.kinds[task.chains[chain as usize].kind].name
        ),
    };
    format!(
        "done {:09b} person [{chain} {}] AOL [{}] ASL [{}] IL [{}] EML [{}] available [{}] AEL [{decision}] motion {}",
        truth.achieved,
        truth.phase,
        peaks(LayerKind::ActionObservation),
        peaks(LayerKind::ActionSimulation),
        peaks(LayerKind::Intention),
        peaks(LayerKind::ErrorMonitoring),
        peaks(LayerKind::SubgoalsAvailable),
        stages.command.phase,
    )
}
