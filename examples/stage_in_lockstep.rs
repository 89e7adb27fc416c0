//! A stage of one's own beside coact's stages in lockstep: how fast is the person's hand when the robot decides?
//!
//! `cargo run -p coact-examples --example stage_in_lockstep`
//!
//! The stage itself is `HandSpeed` in `examples/src/hand_speed.rs`; `stage_as_process` runs it in a real set.

use coact_examples::HandSpeed;
use coact_lockstep::Lockstep;
use coact_messages::NONE;
use coact_period::{cycles, seconds};
use coact_pipeline::{RunSettings, WorldMode};
use std::path::Path;
use std::time::Duration;

fn main() -> anyhow::Result<()> {
    let rt_config = Path::new(env!("CARGO_MANIFEST_DIR")).join("../rt-config");
    let shipped = RunSettings::shipped(&rt_config);
    let mut stages = Lockstep::new(&RunSettings { world: WorldMode::Kinematic, ..shipped })?;
    let (mut previous, mut speed): (HandSpeed, HandSpeed) = Default::default();
    let mut decision = NONE;
    while stages.ticks() < cycles(Duration::from_secs(8)) {
        // One period of all of coact's stages, then one of ours, on the messages that they have just made.
        stages.step();
        speed.step(Some(&stages.percept), &previous);
        if speed.reaches > previous.reaches {
            println!("{:7.3} s  reach {} begins", seconds(stages.ticks()), speed.reaches);
        }
        if stages.frame.decision.action != decision {
            decision = stages.frame.decision.action;
            let name = match decision {
                NONE => "nothing",
                action => &stages.task().actions[action as usize].name,
            };
            println!("{:7.3} s  hand at {:.2} m/s  decides: {name}", seconds(stages.ticks()), speed.now);
        }
        previous = speed;
    }
    println!("{} reaches, the last one with {:.2} m/s at most", speed.reaches, speed.highest);
    Ok(())
}
