//! What a step of the network costs against the number of its populations: tasks of 10 to 50 subgoals.
//!
//! `cargo bench -p coact-lockstep --bench populations`
#![allow(missing_docs, clippy::expect_used, reason = "a bench on generated tasks")]

#[path = "../tests/lockstep/generated.rs"]
mod generated;

use coact_fields::Network;
use coact_joint_task::NetworkPlan;
use coact_messages::{FieldFrame, Percept};
use coact_period::CYCLES_PER_SECOND;
use hdrhistogram::Histogram;
use std::hint::black_box;
use std::time::Instant;

/// Steps that are measured for each task: enough for a hundred beyond the 99.9th percentile.
const STEPS: u64 = 100_000;
/// Target for a step of the largest, µs at the 99.9th percentile: 6 % of a period. Chosen by hand.
const TARGET_US: f64 = 60.0;

fn main() {
    let mut last = 0;
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
            percept.act[(tick / CYCLES_PER_SECOND) as usize % task.acts.len()] = 1.0;
            let begin = Instant::now();
            network.step(tick, Some(&percept), &now, &mut next);
            taken.saturating_record(begin.elapsed().as_nanos() as u64);
            std::mem::swap(&mut now, &mut next);
        }
        println!(
            "{subgoals} subgoals, {parts} parts: {populations:4} populations, {synapses:5} synapses: \
             {}  (target {TARGET_US})",
            percentiles(&taken)
        );
        last = taken.value_at_quantile(0.5);
    }
    println!(
        "the machine itself, in plain arithmetic of the last length:     {}",
        percentiles(&arithmetic(last))
    );
}

fn percentiles(taken: &Histogram<u64>) -> String {
    let [p50, p99, p999] = [0.5, 0.99, 0.999].map(|quantile| taken.value_at_quantile(quantile) as f64 / 1e3);
    format!("p50 {p50:6.1} µs  p99 {p99:6.1} µs  p99.9 {p999:6.1} µs")
}

/// Work that touches no memory and always takes the same number of operations, about `length_ns` each time: what
/// it takes longer now and then is the machine's.
fn arithmetic(length_ns: u64) -> Histogram<u64> {
    let timed = |rounds: u64| {
        let begin = Instant::now();
        black_box((0..rounds).fold(1.0_f64, |value, round| value * 0.999 + round as f64));
        begin.elapsed().as_nanos() as u64
    };
    const SAMPLE: u64 = 10_000;
    let fastest = (0..100).map(|_| timed(SAMPLE)).min().unwrap_or(1).max(1);
    let mut taken = coact_monitor::histogram();
    (0..STEPS).for_each(|_| taken.saturating_record(timed(SAMPLE * length_ns / fastest)));
    taken
}
