//! Reads a topic of a running set: five looks at the newest field frame. Start `tools/launch` in another terminal first.
//!
//! `cargo run -p coact-examples --example read_topic -- [RUN DIRECTORY]`; without one, the newest run is read.
//!
//! A reader only looks: nothing waits for it. Which topics there are, and who may read them, stands in
//! `coact_messages::topic::ALL`.

use anyhow::Context;
use coact_joint_task::NetworkPlan;
use coact_messages::{FieldFrame, LayerKind, NONE, topic};
use coact_pipeline::Run;
use coact_realtime::{Bus, Input};
use std::time::Duration;

fn main() -> anyhow::Result<()> {
    let run = match std::env::args_os().nth(1) {
        Some(directory) => Run::load(directory.as_ref())?,
        None => newest_run().context("no set is running; start tools/launch in another terminal")?,
    };
    // The names of what populations stand for come from the run's own task file.
    let (task, plan) = NetworkPlan::load(&run.settings().task)?;
    let bus = Bus::open(&run, "read-topic", 0)?;
    let mut frames: Input<FieldFrame> = bus.input(topic::FIELDS)?;
    println!("run {}: {}", run.id(), task.name);
    for _ in 0..5 {
        // Takes in what has come, and keeps the newest; never blocks.
        while !frames.refresh()? {
            anyhow::ensure!(run.owner_lives(), "the run has ended");
            std::thread::sleep(Duration::from_millis(1));
        }
        let frame = frames.latest().context("a frame was there")?;
        let decision = match frame.decision.action {
            NONE => "nothing",
            action => task.actions.get(action as usize).map_or("of another task", |action| &action.name),
        };
        println!(
            "cycle {:8}  intention [{}]  decides: {decision}",
            frame.header.cycle,
            peaks(frame, &plan, LayerKind::Intention)
        );
        std::thread::sleep(Duration::from_millis(200));
    }
    Ok(())
}

/// What the populations of this layer stand for that hold a peak.
fn peaks(frame: &FieldFrame, plan: &NetworkPlan, layer: LayerKind) -> String {
    let standing = frame.populations(layer).filter(|&population| frame.signal[population] > 0.5);
    standing.map(|population| plan.meaning(population).label.as_str()).collect::<Vec<_>>().join(", ")
}

fn newest_run() -> Option<Run> {
    let created = |run: &Run| run.directory().metadata().and_then(|metadata| metadata.modified()).ok();
    Run::all().into_iter().filter(Run::owner_lives).max_by_key(created)
}
