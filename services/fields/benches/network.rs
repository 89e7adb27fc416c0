//! One step of the complete network of the shipped task.
#![allow(missing_docs)]

use coact_fields::Network;
use coact_joint_task::NetworkPlan;
use coact_messages::{FieldFrame, Percept};
use criterion::{Criterion, criterion_group, criterion_main};
use std::path::Path;

fn step(criterion: &mut Criterion) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
    let (task, plan) = NetworkPlan::load(&path).expect("the shipped task is valid");
    let mut network = Network::new(plan, task.fingerprint, 1).expect("the shipped network is valid");
    let mut percept: Box<Percept> = bytemuck::zeroed_box();
    percept.workspace[1].seen[..4].fill(1.0);
    percept.act[0] = 1.0;
    percept.destinations.told = 1.0;
    for (kind, fit) in [1.0, 0.5, 0.2, 0.1].into_iter().enumerate() {
        percept.destinations.push(Some(kind), [-1.0, 0.1 * kind as f64], fit);
    }
    percept.grips.count = 2;
    percept.grips.pitch[..2].copy_from_slice(&[-1.3, -0.2]);
    percept.grips.fit[..2].copy_from_slice(&[1.0, 0.3]);
    let (mut now, mut next): (Box<FieldFrame>, Box<FieldFrame>) =
        (bytemuck::zeroed_box(), bytemuck::zeroed_box());
    network.rest(&mut now);
    let mut tick = 0;
    criterion.bench_function("network step", |bencher| {
        bencher.iter(|| {
            percept.header.cycle = tick;
            network.step(tick, Some(&percept), &now, &mut next);
            std::mem::swap(&mut now, &mut next);
            tick += 1;
        });
    });
}

criterion_group!(benches, step);
criterion_main!(benches);
