//! What a step of the network costs against the number of its populations: tasks of 10 to 50 subgoals.
//!
//! `cargo bench -p coact-lockstep --bench populations`
#![allow(missing_docs, clippy::expect_used, reason = "a bench on generated tasks")]

#[path = "../tests/generated/mod.rs"]
mod generated;

use coact_fields::Network;
use coact_joint_task::NetworkPlan;
use coact_messages::{FieldFrame, Percept};
use std::time::Instant;

/// Steps that are measured for each task.
const STEPS: u64 = 100_000;
/// Target for a step of the largest, µs at the 99.9th percentile.
const TARGET_US: f64 = 60.0;

fn main() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    for (subgoals, parts) in [(10, 10), (20, 16), (30, 20), (40, 26), (50, 30)] {
        let path = generated::write(folder.path(), subgoals, parts);
        let (task, plan) = NetworkPlan::load(&path).expect("the generated task is valid");
        let (populations, synapses) = (plan.populations.len(), plan.synapses.len());
        let mut percept: Box<Percept> = bytemuck::zeroed_box();
        for part in &task.parts {
            percept.workspace[part.workspace.index()].seen[part.kind] = 1.0;
        }
        let mut network = Network::new(plan, task.fingerprint, 1).expect("the network is valid");
        let (mut now, mut next): (Box<FieldFrame>, Box<FieldFrame>) =
            (bytemuck::zeroed_box(), bytemuck::zeroed_box());
        network.rest(&mut now);
        let mut taken = coact_monitor::histogram();
        for tick in 0..STEPS {
            percept.header.cycle = tick;
            // The person moves on every second: rests, idles, grasps.
            percept.act.fill(0.0);
            percept.act[(tick / 1000) as usize % task.acts.len()] = 1.0;
            let begin = Instant::now();
            network.step(tick, Some(&percept), &now, &mut next);
            taken.saturating_record(begin.elapsed().as_nanos() as u64);
            std::mem::swap(&mut now, &mut next);
        }
        let [p50, p99, p999] = [0.5, 0.99, 0.999].map(|share| taken.value_at_quantile(share) as f64 / 1e3);
        println!(
            "{subgoals} subgoals, {parts} parts: {populations:4} populations, {synapses:5} synapses: \
             p50 {p50:6.1} µs  p99 {p99:6.1} µs  p99.9 {p999:6.1} µs  (target {TARGET_US})"
        );
    }
}
